//! Pass `list_build/atomic_counters`: every view-sample adds one to its light texel's counter and keeps the number it found
//! there (Sintorn 2008, section 3.1, "Construction").
//!
//! In: `position [P,3] f32, world`, `sample_state [P] u32`, `light_frame [F,20] f32, world`. Out: `cell [P] u32`,
//! `slot [P] u32`, `list_length [F,S,S] u32`, `list_far [F,S,S] f32, scene units`.
//!
//! Invariants: the lengths sum to the kept view-samples that a face sees; the slots of a cell are 0..length, each once.
//! Which view-sample gets which slot differs from run to run. `slot` is undefined where `cell` says none.
//! Kept view-samples that no face sees are counted, and an error: they would be lit in silence.
//! The two backends may put a view-sample in neighbouring cells where its coordinate rounds to the border between them.

pub(super) mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// One counter a cell.
pub static PASS: Pass = Pass {
    name: "atomic_counters",
    stage: &super::STAGE,
    doc: "Each view-sample's slot is what its cell's atomic counter held.",
    source: "Sintorn 2008, section 3.1",
    ignores: &[],
    params: &[super::SIZE],
    counters: &[super::UNPLACED, super::LONGEST],
    contract: Contract::Sets,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
