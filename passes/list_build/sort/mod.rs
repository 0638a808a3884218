//! Pass `list_build/sort`: view-samples sorted by light texel; a slot is the rank within the texel (the lists of Sintorn
//! 2008, section 3.1, without counters; Satish, Harris, Garland 2009, "Designing efficient sorting algorithms for manycore
//! GPUs", section 4).
//!
//! In: `position [P,3] f32, world`, `sample_state [P] u32`, `light_frame [F,20] f32, world`. Out: `cell [P] u32`,
//! `slot [P] u32`, `list_length [F,S,S] u32`, `list_far [F,S,S] f32, scene units`.
//!
//! The sort is stable, so lists are in view order and equal from run to run, on any number of threads. No counter is
//! shared: a scene whose view-samples all fall in one texel costs no more than another. Costs more where they spread.
//! `slot` is 0 where `cell` says none. Kept view-samples that no face sees are counted, and an error.
//! The two backends may put a view-sample in neighbouring cells where its coordinate rounds to the border between them.

pub(super) mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// A stable radix sort.
pub static PASS: Pass = Pass {
    name: "sort",
    stage: &super::STAGE,
    doc: "Each view-sample's slot is its rank among those of its cell, in view order: the same lists in every run.",
    source: "Sintorn 2008, section 3.1; Satish, Harris, Garland 2009, section 4",
    ignores: &[],
    params: &[super::SIZE],
    counters: &[super::UNPLACED, super::LONGEST],
    contract: Contract::Sets,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
