//! Pass `view_samples/cast`: one ray through each pixel centre, against a tree of boxes over the triangles: a way to the same
//! view-samples that shares no z-buffer with `raster`.
//!
//! In: `triangles [T 3 3] f32, world`, `camera [20] f32, world`. Out, with P = width x height in row order from the top left:
//! `position`, `normal [P 3] f32, world`, `triangle`, `pixel [P] u32`.
//!
//! A triangle is hit where the edge functions of `raster` say that the pixel sees it, so the two agree to the bit; the nearest
//! is found by walking the tree, whose boxes are a little too wide and never too narrow. CPU only: a tree built on a GPU for
//! one frame of primary rays would cost more than rasterising.

mod cpu;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};

pub use cpu::cast;

/// Rays.
pub static PASS: Pass = Pass {
    name: "cast",
    stage: &super::STAGE,
    doc: "Casts a ray through each pixel.",
    source: "Sintorn 2008, section 3, overview; Appel 1968",
    ignores: &[
        input::IMPORTED_POSITION.name,
        input::IMPORTED_NORMAL.name,
        input::IMPORTED_TRIANGLE.name,
        input::IMPORTED_PIXEL.name,
        ports::GBUFFER_POSITION.name,
        ports::GBUFFER_NORMAL.name,
        ports::GBUFFER_TRIANGLE.name,
    ],
    params: &[],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size: super::size_of_image,
    cpu: Some(cpu::run),
    gpu: None,
};
