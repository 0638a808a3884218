//! `second_surface`: second-depth shadow map, the second nearest caster in every texel (Wang, Molnar 1994).
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts), `light_frame [F 20]`. Out: `depth [F D D]`, 0 near to 1 far,
//! hyperbolic as in [`crate::shared::shadow_map`]; 1 where no second surface is seen; a face without view-samples is all 1.
//!
//! A lit surface of a solid body is the first one seen, so it is compared with the body's far side and needs no bias. The
//! second surface is found by peeling: one map of the nearest depth, then the nearest of what lies behind it by more than
//! [`crate::shared::shadow_map::SECOND_STEP`]. Any mesh is taken as it is, not by its back faces, so closed bodies of either
//! winding serve. Fails where it must: a thin or open caster's second surface is its receiver, which light then leaks onto.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "second_surface",
    stage: &super::STAGE,
    doc: "Depth of the second nearest caster in every texel: closed bodies then need no bias.",
    source: "Wang, Molnar 1994",
    ignores: &[],
    params: &[super::SIZE],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
