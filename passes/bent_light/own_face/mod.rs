//! `own_face`: the light term of flat shading at every corner, to compare smooth ones with.
//!
//! In: `triangles [T 3 3]` world, `light [8]` world (its centre). Out: `corner_light [T 3]`, the cosine between the direction from
//! the corner to the light and the triangle's own normal, -1..1; 0 for a degenerate triangle.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "own_face",
    stage: &super::STAGE,
    doc: "The cosine at each corner with the triangle's own normal only: flat shading.",
    source: "Sintorn 2008, section 4.3, Shading, with no neighbours",
    ignores: &["corner_vertex", "face_offset", "faces", "light_samples"],
    params: &[],
    counters: &[],
    contract: Contract::Within(1e-4),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
