//! Pass `casters/light_back_facing`: of a closed two-manifold only the triangles that turn their back on the light cast
//! (Sintorn 2008, section 3.3, "Avoiding bias").
//!
//! In: `triangles [T,3,3] f32, world`, `triangle_flags [T] u32`, `light_samples [L,3] f32, world`. Out: `caster_state [T]
//! u32`. A triangle is left out if and only if it is flagged as part of a closed two-manifold and no light sample lies
//! strictly behind it: `orient3d(A, B, C, S) <= 0` for every S. Open meshes keep both sides.
//!
//! Exact on the CPU. On a GPU single precision decides with a margin and keeps what is uncertain, so its casters are a
//! superset: more work, the same shadows.
//!
//! A segment from the light that enters a closed mesh through its front leaves it through its back, so what the front
//! hides the back hides too, but for view-samples inside the mesh and on its own turned-away side. The latter need no
//! test where `sample_filter/light_facing` drops them. Where meshes stand in one another or the filter keeps all, use
//! `casters/all`.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};

/// Leaves out the lit side of closed meshes.
pub static PASS: Pass = Pass {
    name: "light_back_facing",
    stage: &super::STAGE,
    doc: "Of closed meshes only the triangles turned away from the light cast; open meshes keep both sides.",
    source: "Sintorn 2008, section 3.3",
    ignores: &[],
    params: &[],
    counters: &[Counter { name: "culled", doc: "triangles left out", kind: CounterKind::Info }],
    contract: Contract::Superset,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
