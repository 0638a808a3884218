//! `adjacent_faces`: at every corner the smallest light term of the faces around its vertex, so that interpolation is smooth and
//! black on every face turned away from the light (Sintorn, Eisemann, Assarsson 2008, section 4.3, Shading).
//!
//! In: `triangles [T 3 3]` world, `corner_vertex [T 3]`, `face_offset [V+1]`, `faces [K]`, `light [8]` world (its centre). Out:
//! `corner_light [T 3]`, `l_bend = min over F in adj(v) of dot(l, n_F)`, -1..1, l the unit direction from v to the light's centre.
//!
//! A triangle counts at its own corners whether listed or not, so a face turned away is black by construction. Degenerate
//! triangles have no normal and do not count; a corner around which all are degenerate has 0. A triangle listed around a
//! vertex that is none of its corners' does not count. On a GPU one invocation takes one entry of `faces`, so that vertices of
//! any valence cost no loop.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "adjacent_faces",
    stage: &super::STAGE,
    doc: "Bent light: the smallest cosine among the faces around each vertex.",
    source: "Sintorn 2008, section 4.3, Shading",
    ignores: &["light_samples"],
    params: &[],
    counters: &[],
    contract: Contract::Within(1e-4),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
