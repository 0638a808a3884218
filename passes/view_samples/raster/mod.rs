//! Pass `view_samples/raster`: the nearest triangle at each pixel centre by a z-buffer, and the surface point seen there
//! (Sintorn 2008, section 3, overview: "the scene is rendered from the viewpoint").
//!
//! In: `triangles [T 3 3] f32, world`, `camera [20] f32, world`. Out, with P = width x height in row order from the top left:
//! `position`, `normal [P 3] f32, world`, `triangle`, `pixel [P] u32`.
//!
//! The z-buffer decides the triangle only. The position is where the ray through the pixel's centre meets the triangle's
//! plane, so it does not depend on depth precision; the normal is geometric, on the viewer's side. Triangles are seen from both
//! sides and may cross the eye plane; those seen exactly from their edge are not seen. Of equally near triangles the CPU
//! takes the lowest; the GPU leaves it to the order of its fragments.
//!
//! CPU: f64 throughout, rounded once. GPU: the device's rasteriser with a linear depth of 24 bits of mantissa, positions in f32
//! within the triangle, relative to one of its corners; what is nearer than a millionth of the farthest corner's depth is cut away.
//! Background rows hold zeros and the triangle with all bits set.

mod bins;
mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};

pub use cpu::raster;

/// A z-buffer.
pub static PASS: Pass = Pass {
    name: "raster",
    stage: &super::STAGE,
    doc: "Rasterises the scene from the camera.",
    source: "Sintorn 2008, section 3, overview",
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
    gpu: Some(gpu::record),
};
