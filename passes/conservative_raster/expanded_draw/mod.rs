//! `expanded_draw`: each caster's outline, grown by half a texel, through the rasteriser; its fragments are the pairs.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 3.2 and Figure 4, after Hasselgren, Akenine-Moller, Ohlsson 2005: always six vertices and
//! four triangles a caster. The paper grows outlines in a geometry program; here a kernel does, once a caster and face.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [1 3]` world, `light_frame [F 20]`,
//! `list_length [F S S]`, `list_far [F S S]` scene units along the face's axis.
//! Out: `pair_cell`, `pair_slot`, `pair_caster` `[E]`, `caster_length [F S S]`, as of `binning`.
//!
//! Casters seen edge-on, needles, those that pass the plane beside the light and those that reach beyond the window are drawn as boxes.
//! Fragments of texels that the caster does not touch, or that lie wholly before it, make no pair: superset, a miss never. Takes
//! one light sample; more is an error.

mod gpu;

use super::{PAIRS, STAGE, pairs_size};
use shadowgraph_core::pass::{Contract, Feature, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "expanded_draw",
    stage: &STAGE,
    doc: "Draws each caster grown by half a texel, six vertices each.",
    source: "Sintorn 2008, section 3.2, Figure 4",
    ignores: &[],
    params: &[],
    counters: &[PAIRS],
    contract: Contract::Superset,
    features: &[Feature::FragmentWritableStorage],
    size: pairs_size,
    cpu: None,
    gpu: Some(gpu::record),
};
