//! `lu_certain`: per view-sample, the planes of every caster that its cell lists looked up, and what the table leaves open decided by
//! arithmetic: exact at the speed of a table.
//!
//! After Sintorn, Eisemann, Assarsson 2008, section 4.2, with a table that keeps apart light samples that are surely behind every plane of
//! a bin and those that may be behind one. A light sample that is certain for all planes of a caster is hidden; one that is not
//! possible for some is not; the rest are tested as `half_planes` tests.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [L 3]` world, `position [P 3]` world, `triangle [P]`,
//! `sample_state [P]`, `cell [P]`, lists of view-samples (`list_offset`, `list_entries`) and of casters (`caster_offset`,
//! `caster_entries`) by cell, `lu [K A A A 8]` and `lu_layout [16]` of `lu_table/certain_uncertain`.
//! Optional: `penumbra_state [P]`: where it is 0 the first light sample answers for all.
//! Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a view-sample facing away, none for background.
//!
//! On the CPU the mask equals [`crate::shared::predicate::blocks`] for every light sample, bit for bit, given casters that hold all that
//! matter. A plane whose direction rounding may move by more than the table's slack is not looked up. Errors: another table, or none.

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
const FORM: Form = Form { pass: "certain_uncertain", is_solid: true, entry_words: 8 };

/// The pass.
pub static PASS: Pass = Pass {
    name: "lu_certain",
    stage: &STAGE,
    doc: "Looks up what is certain and decides the rest by arithmetic: exact.",
    source: "Sintorn 2008, section 4.2; departs: certain and possible bits apart",
    ignores: &["light_frame", "normal", "list_length", "list_far", "bvh_nodes", "bvh_order"],
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
