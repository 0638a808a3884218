//! Pass `sample_filter/all`: every view-sample that is not background gets an answer of its own.
//!
//! Where this differs from `light_facing`: a view-sample turned away from the light is listed and tested like any other, so its
//! answer comes from the casters alone. A view-sample whose position is not finite counts as background.
//!
//! In: `position [P 3] f32, world`, `triangle [P] u32`. Out: `sample_state [P] u32`, 0 or 1.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};

/// Keeps all.
pub static PASS: Pass = Pass {
    name: "all",
    stage: &super::STAGE,
    doc: "Keeps every view-sample that is not background.",
    source: "Sintorn 2008, section 3",
    ignores: &[ports::NORMAL.name, input::LIGHT_SAMPLES.name],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
