//! `half_planes`: per view-sample, every light sample against the planes of every caster that its cell lists, by arithmetic.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 4.2, with arithmetic in place of the look-up table: a light sample is hidden when it is
//! inside the three planes through the view-sample and the caster's edges, and beyond the caster. Casters combine by OR; a full mask ends
//! the work on a view-sample. Planes that leave the whole light on one side are decided at once, for all light samples.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [L 3]` world, `position [P 3]` world, `triangle [P]`,
//! `sample_state [P]`, `cell [P]`, lists of view-samples (`list_offset`, `list_entries`) and of casters (`caster_offset`,
//! `caster_entries`) by cell.
//! Optional: `penumbra_state [P]`: where it is 0 the first light sample answers for all.
//! Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a view-sample facing away, none for background.
//!
//! On the CPU the mask equals [`crate::shared::predicate::blocks`] for every light sample, bit for bit, given casters that hold all that
//! matter: planes decide in floating point what their error bounds can vouch for, and the exact predicate the rest. The equations and
//! bounds are those of [`crate::shared::view_planes`]. A view-sample that no cell lists is tested against every casting triangle.
//!
//! Departs from the paper in the supporting plane, which makes casters beyond a light sample harmless.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::shared::segments::mask_words;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "half_planes",
    stage: &STAGE,
    doc: "Tests each light sample against the planes of each caster listed in the view-sample's cell, exactly.",
    source: "Sintorn 2008, section 4.2; departs: arithmetic instead of the look-up table",
    ignores: &["light_frame", "normal", "list_length", "list_far", "lu", "lu_layout", "bvh_nodes", "bvh_order"],
    params: &[],
    counters: &[
        Counter {
            name: "exact_bits",
            doc: "(view-sample, caster, light sample) that only exact arithmetic, on a GPU that of two floats, could decide",
            kind: CounterKind::Info,
        },
        Counter { name: "pairs", doc: "(view-sample, caster) pairs that were met", kind: CounterKind::OnCpu },
        Counter {
            name: "cut_pairs",
            doc: "pairs in which the caster may hide a part of the light",
            kind: CounterKind::OnCpu,
        },
    ],
    contract: Contract::WrongBits(1e-5),
    features: &[Feature::IndirectExecution],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![("mask", vec![cx.dim("position", 0), mask_words(cx.dim("light_samples", 0))])]
}
