//! Pass `scan/work_efficient`: list offsets by a parallel exclusive prefix sum (Sintorn 2008, section 3.1; Harris, Sengupta,
//! Owens 2007, GPU Gems 3, chapter 39).
//!
//! In: `length [F,S,S] u32`, entries in each cell. Out: `offset [C+1] u32`, `offset[i] = sum of length[..i]`, the last the
//! total. Invariant: `offset[i+1] - offset[i] = length[i]`.
//!
//! A total past 32 bits is an error on the CPU. On a GPU it would wrap, but no list that fits a buffer is that long.
//! Instead of the balanced tree in shared memory each invocation sums a run of entries in turn, for the reason given in
//! [`crate::shared::scan`]; the work stays linear.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// Sums of runs, scanned level by level.
pub static PASS: Pass = Pass {
    name: "work_efficient",
    stage: &super::STAGE,
    doc: "Parallel prefix sum in levels, linear work.",
    source: "Sintorn 2008, section 3.1; Harris, Sengupta, Owens 2007, GPU Gems 3, chapter 39",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
