//! Pass `combine/threshold`: lit or not, by the greater part of the light: a shadow without penumbra from an area light.
//!
//! It shows where a soft shadow's half-way line runs, to lay beside the hard shadow of the light's centre, and gives
//! comparisons of two masks a picture in which every difference is one of full contrast. With one light sample it equals
//! `popcount`.
//!
//! In: `mask [P,M] u32` with M = ceil(L/32), `sample_state [P] u32`, the number L of `light_samples`. Out:
//! `visible [P] f32`: 0 where at least half of the light samples are blocked, else 1; 1 for background and where there is
//! no light sample. `visible_color` has no rows.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// Compares with half.
pub static PASS: Pass = Pass {
    name: "threshold",
    stage: &super::STAGE,
    doc: "0 where at least half of the light samples are blocked, else 1: a soft shadow's half-way line.",
    source: "Sintorn 2008, section 3",
    ignores: &["light_weights"],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
