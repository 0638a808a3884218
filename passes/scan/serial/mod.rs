//! Pass `scan/serial`: list offsets by one running sum, entry after entry: the scan to compare others with (Sintorn 2008,
//! section 3.1, "running sum scan").
//!
//! In: `length [F,S,S] u32`, entries in each cell. Out: `offset [C+1] u32`, `offset[i] = sum of length[..i]`, the last the
//! total. Invariant: `offset[i+1] - offset[i] = length[i]`.
//!
//! On a GPU one invocation walks the cells. Because software rasterisers cut long loops, the walk is a chain of dispatches,
//! each going on from the last offset of the one before; past 2^24 cells the chain would be too long and the recipe is
//! refused. A total past 32 bits is an error on the CPU and wraps on a GPU.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// One running sum.
pub static PASS: Pass = Pass {
    name: "serial",
    stage: &super::STAGE,
    doc: "One running sum over all cells, in one thread.",
    source: "Sintorn 2008, section 3.1",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
