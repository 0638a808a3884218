//! `bounding_box`: bent light for an area light: the smallest light term over the faces around a vertex and over a box around the
//! light, so that a face is black as soon as it turns away from any part of the box (Sintorn, Eisemann, Assarsson 2008, section 4.3,
//! Shading: "the minimum with respect to the entire source or a bounding volume (e.g. a cube)").
//!
//! In: `triangles [T 3 3]` world, `corner_vertex [T 3]`, `face_offset [V+1]`, `faces [K]`, `light_samples [L 3]` world. Out:
//! `corner_light [T 3]`, -1..1: `l_bend = min over F in adj(v), c of dot(unit(c - v), n_F)`, c the eight corners of the smallest
//! axis-parallel box around the light samples.
//!
//! The corners stand for the whole box. Where l_bend is not negative it is the exact minimum over every point of the box: points
//! whose cosine is at least some c >= 0 form a convex cone, so a cosine that all corners have, the box has. Where it is negative
//! some corner lies behind a face; the minimum over the whole box may be lower still, but its sign is right: a plane has a point of
//! the box behind it only if it has a corner there. With one light sample the box is that point, and a light sample at the light's
//! centre gives `adjacent_faces`. Without light samples every term is 0.
//!
//! The price is darkness: a face that sees most of a large light and not all of its box is black, and so are the smooth surfaces
//! around it. `adjacent_faces` is lighter, and black only where a face turns away from the light's centre.
//!
//! The box is of the light samples, which are what visibility is asked for, and no larger than the light's own. Degenerate
//! triangles and vertices count as in `adjacent_faces`.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "bounding_box",
    stage: &super::STAGE,
    doc: "Bent light over a box around the light: the smallest cosine of faces around a vertex and corners of the box.",
    source: "Sintorn 2008, section 4.3, Shading, its extension to a bounding volume",
    ignores: &["light"],
    params: &[],
    counters: &[],
    contract: Contract::Within(1e-4),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
