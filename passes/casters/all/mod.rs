//! Pass `casters/all`: every triangle casts. Right for every scene; costs up to twice the tests of `light_back_facing`.
//!
//! In: the number of `triangles [T,3,3]`. Out: `caster_state [T] u32`, all 1. Degenerate triangles are kept: the visibility
//! tests never let one block.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};

/// Leaves none out.
pub static PASS: Pass = Pass {
    name: "all",
    stage: &super::STAGE,
    doc: "Every triangle casts.",
    source: "Sintorn 2008, section 3.3",
    ignores: &[input::TRIANGLE_FLAGS.name, input::LIGHT_SAMPLES.name],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
