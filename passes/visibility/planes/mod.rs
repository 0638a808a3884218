//! `planes`: per cell, every view-sample against every caster listed there, by four planes of the caster.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 3.3: a view-sample is in shadow when it lies behind the supporting plane of the
//! triangle and inside the three planes through the light sample and the edges. Aila, Laine 2004, section 5.1: a cell all of
//! whose view-samples are in shadow takes no more casters.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [1 3]` world, `light_frame [F 20]`, `position [P 3]` world,
//! `triangle [P]`, `sample_state [P]`, lists of view-samples (`list_length`, `list_offset`, `list_entries`) and of casters
//! (`caster_offset`, `caster_entries`) by cell.
//! Out: `mask [P 1]`, bit 0 set = blocked; all bits set for a view-sample facing away, none for background.
//!
//! On the CPU the mask equals [`crate::shared::predicate::blocks`] bit for bit: planes decide in floating point what their error
//! bounds can vouch for, and the exact predicate the rest. Takes one light sample; more is an error.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::shared::pair_counts::PAIR_COUNTERS;
use shadowgraph_core::pass::{Contract, Feature, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "planes",
    stage: &STAGE,
    doc: "Tests each view-sample of a cell against the planes of each caster listed there.",
    source: "Sintorn 2008, section 3.3; Aila, Laine 2004, section 5.1",
    ignores: &["normal", "list_far", "lu", "lu_layout", "bvh_nodes", "bvh_order", "penumbra_state"],
    params: &[],
    counters: PAIR_COUNTERS,
    contract: Contract::WrongBits(1e-5),
    features: &[Feature::IndirectExecution],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![("mask", vec![cx.dim("position", 0), 1])]
}
