//! `fused`: each caster walks the cells under its footprint and tests their view-samples there and then.
//!
//! Sintorn, Eisemann, Assarsson 2008, sections 3.2 and 3.3 in one step, as the paper's own fragment program does; no caster table
//! is made. Aila, Laine 2004, section 5.1: cells wholly nearer than the caster, and cells wholly in shadow, are skipped.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [1 3]` world, `light_frame [F 20]`, `position [P 3]` world,
//! `triangle [P]`, `sample_state [P]`, and the lists of view-samples by cell.
//! Out: `mask [P 1]`, bit 0 set = blocked; all bits set for a view-sample facing away, none for background.
//!
//! On the CPU the mask equals [`crate::shared::predicate::blocks`] bit for bit, as that of `planes` does. Takes one light
//! sample; more is an error.
//!
//! What makes it fast there, with what was found on two threads of an AVX-512 machine:
//! - texels of a row are neighbours in the list table, so a caster's row is one run, tested sixteen at a time in (u, v, 1/depth),
//!   where three of four planes need no depth: a test costs a few nanoseconds, setting up a caster under a hundred;
//! - no caster table: at a million triangles about half the time of binning, filling and `planes`;
//! - positions asked for ahead of their use when lists are gathered: a quarter less at a thousand triangles, where gathering is
//!   most of the work. Asking for cells ahead of their casters brought nothing: setting up casters hides that already;
//! - side planes of where view-samples are, tried before anything else: five of six faces are done with a caster at once;
//! - trees over long lists ([`crate::shared::receiver_tree`]): all of a 1024 x 768 view in one texel costs three times the
//!   time of short lists, at 100,000 triangles as at a million.

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
    name: "fused",
    stage: &STAGE,
    doc: "Tests the view-samples of every cell under each caster's footprint at once, without a caster table.",
    source: "Sintorn 2008, sections 3.2 and 3.3; Aila, Laine 2004, section 5.1",
    ignores: &[
        "normal",
        "caster_offset",
        "caster_entries",
        "lu",
        "lu_layout",
        "bvh_nodes",
        "bvh_order",
        "penumbra_state",
    ],
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
