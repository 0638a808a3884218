//! Pass `list_fill/direct`: every view-sample writes its index to its place in the one packed array (Sintorn 2008, section
//! 3.1, "Storage").
//!
//! In: `cell [P] u32`, `slot [P] u32`, `list_offset [C+1] u32`. Out: `list_entries [P] u32`,
//! `list_entries[list_offset[cell[i]] + slot[i]] = i`; past the total zero on the CPU and undefined on a GPU.
//!
//! Invariant: every listed view-sample stands there once. The paper copies positions; an index lets every reader take
//! what it needs.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// One write a view-sample.
pub static PASS: Pass = Pass {
    name: "direct",
    stage: &super::STAGE,
    doc: "Each view-sample writes its index to its place.",
    source: "Sintorn 2008, section 3.1",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Sets,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
