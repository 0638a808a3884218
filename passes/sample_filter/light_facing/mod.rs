//! Pass `sample_filter/light_facing`: a view-sample whose surface is turned away from the light is in its own shadow, and
//! needs no list (Sintorn 2008, section 3, Figure 2).
//!
//! In: `position`, `normal [P 3] f32, world`, `triangle [P] u32`, `light_samples [L 3] f32, world`. Out: `sample_state [P] u32`.
//!
//! A view-sample is dropped (state 2) iff dot(normal, S - position) <= 0 for every light sample S; the CPU evaluates this
//! in f64 on the stored words, the GPU in f32, so the two may differ where the light grazes the surface.
//! A view-sample whose position is not finite counts as background.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// Keeps those that face the light.
pub static PASS: Pass = Pass {
    name: "light_facing",
    stage: &super::STAGE,
    doc: "Drops view-samples that face away from every light sample: their masks are full.",
    source: "Sintorn 2008, section 3, Figure 2",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::WrongBits(1e-5),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
