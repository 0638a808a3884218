//! `bent_lambert`: Lambert's cosine with interpolated normals, bent to black on every face turned away from the light (Sintorn,
//! Eisemann, Assarsson 2008, section 4.3, Shading; the right of its Figure 8).
//!
//! In: view-samples (`position`, `normal`, `triangle`, `pixel`, `sample_state`), `visible [P]` or
//! `visible_color [P 3]`, the scene's `triangles`,
//! `triangle_normals`, `triangle_albedo`, `corner_light [T 3]`, `light [8]`. Out: `image [H W 4]`, linear RGB and coverage, 1 where a
//! surface is seen.
//!
//! With l_f = max(n . l, 0) of the interpolated normal n, l_bend interpolated from `corner_light`, and
//! alpha = min(1, max(c l_bend, 0)): `radiance = albedo (ambient + visible light (alpha l_f + (1 - alpha) max(l_bend, 0)))`.
//!
//! `corner_light` speaks for the side from which a triangle's corners turn counter-clockwise. Seen from the other side, n is
//! turned over and l_bend is the smaller of -l_bend and the cosine of the triangle itself: still black where the triangle
//! turns away, though not smooth there, which the paper's closed casters never show.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::params::{AMBIENT, BACKGROUND_BLUE, BACKGROUND_GREEN, BACKGROUND_RED, FALLOFF, FALLOFF_DISTANCE};
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Pass};

const SHARPNESS: ParamSpec = ParamSpec {
    name: "c",
    range: Range::F32 { min: 0.0, max: 1e6, default: 3.0 },
    unit: "",
    doc: "smooth shading reaches closer to the terminator as it grows, and darkens more suddenly there",
};

/// The pass.
pub static PASS: Pass = Pass {
    name: "bent_lambert",
    stage: &super::STAGE,
    doc: "Lambert shading with smooth normals that leak no light onto faces turned away.",
    source: "Sintorn 2008, section 4.3, Shading",
    ignores: &["camera", "mask", "light_samples", "light_weights"],
    params: &[SHARPNESS, AMBIENT, FALLOFF, FALLOFF_DISTANCE, BACKGROUND_RED, BACKGROUND_GREEN, BACKGROUND_BLUE],
    counters: &[super::OUTSIDE],
    contract: Contract::Within(1e-3),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
