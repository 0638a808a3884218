//! `binning`: each caster's footprint on the light's image, cell by cell, into pairs.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 3.2 (every texel touched, however little), in compute instead of a draw; Aila,
//! Laine 2004, section 5.1 (a cell all of whose view-samples are nearer to the light than the caster is skipped).
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [1 3]` world, `light_frame [F 20]`,
//! `list_length [F S S]`, `list_far [F S S]` scene units along the face's axis.
//! Out: `pair_cell`, `pair_slot`, `pair_caster` `[E]`, `caster_length [F S S]`.
//!
//! A caster covers direction (u, v, 1) of a face when three linear functions of (u, v) share a sign
//! ([`crate::shared::footprint`]); a cell is paired unless one of them is negative on all of its padded square. Superset: rounding
//! only adds pairs. After it, `caster_length` sums to the number of pairs, and the slots of a cell's pairs are 0, 1, 2, ...
//! without gaps, in unspecified order. Cells without view-samples get no pairs.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::{PAIRS, STAGE, pairs_size};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "binning",
    stage: &STAGE,
    doc: "Walks the texels under each caster's exact footprint.",
    source: "Sintorn 2008, section 3.2; Aila, Laine 2004, section 5.1",
    ignores: &[],
    params: &[],
    counters: &[
        PAIRS,
        Counter {
            name: "pairs_behind",
            doc: "pairs left out because every view-sample of the cell is nearer than the caster",
            kind: CounterKind::Info,
        },
    ],
    contract: Contract::Superset,
    features: &[Feature::IndirectExecution],
    size: pairs_size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
