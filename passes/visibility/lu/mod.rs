//! `lu`: per view-sample, the planes of every caster that its cell lists looked up in a table of light samples.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 4.2: the light samples behind the planes of the view-sample and the caster's edges come out of
//! `lu` as bit patterns, 128 at a time; their AND is what the caster hides, and casters combine by OR.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [L 3]` world, `position [P 3]` world, `triangle [P]`,
//! `sample_state [P]`, `cell [P]`, lists of view-samples (`list_offset`, `list_entries`) and of casters (`caster_offset`,
//! `caster_entries`) by cell, `lu [K A A A 4]` and `lu_layout [16]` of `lu_table/angles_distance`.
//! Optional: `penumbra_state [P]`: where it is 0 the first light sample answers for all.
//! Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a view-sample facing away, none for background.
//!
//! An approximation: a plane takes the bits of the middle of its bin. Planes that leave the whole light on one side are not looked up and
//! not wrong. No crack opens at a shared edge: both neighbours look up the edge with its ends in one order and complement the bits
//! ([`crate::shared::view_planes`]).
//!
//! Errors: another table, or none. Departs from the paper in a fourth look-up, of the supporting plane where it cuts the light, without which
//! a caster beyond the light would block it; and own planes follow the coplanar rule.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::shared::lu::Form;
use crate::shared::segments::mask_words;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};
use shadowgraph_core::size::SizeCx;

/// The table it looks up.
const FORM: Form = Form { pass: "angles_distance", is_solid: true, entry_words: 4 };

/// The pass.
pub static PASS: Pass = Pass {
    name: "lu",
    stage: &STAGE,
    doc: "Looks up the planes of each caster listed in the view-sample's cell in a table over two angles and a distance.",
    source: "Sintorn 2008, section 4.2",
    ignores: &["light_frame", "normal", "list_length", "list_far", "bvh_nodes", "bvh_order"],
    params: &[],
    counters: &[
        Counter {
            name: "exact_bits",
            doc: "on a GPU: (view-sample, caster, light sample) decided by arithmetic, where the coplanar rule is in doubt",
            kind: CounterKind::Info,
        },
        Counter { name: "pairs", doc: "(view-sample, caster) pairs that were met", kind: CounterKind::OnCpu },
        Counter {
            name: "cut_pairs",
            doc: "pairs in which the caster may hide a part of the light",
            kind: CounterKind::OnCpu,
        },
    ],
    contract: Contract::Approximate,
    features: &[Feature::IndirectExecution],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![("mask", vec![cx.dim("position", 0), mask_words(cx.dim("light_samples", 0))])]
}
