//! `compare`: the view-sample's own texel of the shadow map, lit or not (Williams 1978).
//!
//! In: `depth [F D D]`, `light_frame [F 20]`, `position [P 3]` world, `normal [P 3]` world, `sample_state [P]`, one light sample.
//! Out: `mask [P 1]`, bit 0 set = blocked; `visible [P]`, 0 or 1. A view-sample facing away has all bits set and sees nothing;
//! background has none and sees all. What falls outside the map is lit.
//!
//! Biases and their units are told in [`crate::shared::shadow_lookup`]; none is without an artefact of its own.

mod gpu;
#[cfg(test)]
mod tests;

use crate::shared::shadow_lookup::{BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::problem::Problem;

/// The pass.
pub static PASS: Pass = Pass {
    name: "compare",
    stage: &super::STAGE,
    doc: "One comparison with the shadow map, with constant, slope-scaled and normal-offset bias.",
    source: "Williams 1978",
    ignores: &["light"],
    params: &[BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size: super::size,
    cpu: Some(run),
    gpu: Some(gpu::record),
};

fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    super::look_up(cx, 1)
}
