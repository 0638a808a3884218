//! `first_surface`: the shadow map proper, the nearest caster in every texel (Williams 1978).
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts), `light_frame [F 20]`. Out: `depth [F D D]`, 0 near to 1 far,
//! hyperbolic as in [`crate::shared::shadow_map`]; 1 where nothing is seen; a face without view-samples is all 1.
//!
//! A texel holds the depth at its centre, so casters thinner than a texel may be missed: this is the baseline whose aliasing
//! the list methods do without. On a GPU one depth-only draw for each face; coverage and interpolation are the device's, so
//! the CPU twin differs in texels at edges.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "first_surface",
    stage: &super::STAGE,
    doc: "Depth of the nearest caster in every texel.",
    source: "Williams 1978",
    ignores: &[],
    params: &[super::SIZE],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
