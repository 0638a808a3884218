//! `device`: each caster's outline through the device's own conservative rasteriser; its fragments are the pairs.
//!
//! What Sintorn, Eisemann, Assarsson 2008, section 3.2 build by hand, where the device has it. Outlines are grown only by what rounding
//! may have moved view-samples, so that these, too, find their casters.
//!
//! In and out as of `expanded_draw`. Superset, as of `expanded_draw`.

mod gpu;

use super::{PAIRS, STAGE, pairs_size};
use shadowgraph_core::pass::{Contract, Feature, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "device",
    stage: &STAGE,
    doc: "Draws each caster with the device's conservative rasterisation.",
    source: "Sintorn 2008, section 3.2",
    ignores: &[],
    params: &[],
    counters: &[PAIRS],
    contract: Contract::Superset,
    features: &[Feature::FragmentWritableStorage, Feature::ConservativeRasterization],
    size: pairs_size,
    cpu: None,
    gpu: Some(gpu::record),
};
