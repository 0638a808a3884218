//! `phong`: Lambert's cosine with interpolated normals, and a highlight if asked for (Phong 1975; Gouraud 1971). Light leaks onto
//! faces turned away from it, which accurate shadows then cut off hard: the left of Figure 8 of Sintorn, Eisemann, Assarsson 2008.
//!
//! In: view-samples (`position`, `normal`, `triangle`, `pixel`, `sample_state`), `visible [P]` or
//! `visible_color [P 3]`, the scene's `triangles`,
//! `triangle_normals`, `triangle_albedo`, `camera [20]`, `light [8]`. Out: `image [H W 4]`, linear RGB and coverage, 1 where a surface
//! is seen.
//!
//! With the interpolated normal n turned to the viewer's side, l towards the light, v towards the eye, r = 2 (n . l) n - l:
//! `radiance = albedo ambient + visible light (albedo max(n . l, 0) + specular max(r . v, 0)^shininess)`, the highlight only
//! where n . l > 0.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::params::{AMBIENT, BACKGROUND_BLUE, BACKGROUND_GREEN, BACKGROUND_RED, FALLOFF, FALLOFF_DISTANCE};
use super::reflection::{SHININESS, SPECULAR};
use shadowgraph_core::pass::{Contract, Pass};

/// The pass.
pub static PASS: Pass = Pass {
    name: "phong",
    stage: &super::STAGE,
    doc: "Plain shading with smooth normals: light leaks past the terminator.",
    source: "Phong 1975; Sintorn 2008, Figure 8",
    ignores: &["corner_light", "mask", "light_samples", "light_weights"],
    params: &[
        SPECULAR,
        SHININESS,
        AMBIENT,
        FALLOFF,
        FALLOFF_DISTANCE,
        BACKGROUND_RED,
        BACKGROUND_GREEN,
        BACKGROUND_BLUE,
    ],
    counters: &[super::OUTSIDE],
    contract: Contract::Within(1e-3),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
