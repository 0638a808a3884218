//! Stage `view_samples`: The surface points seen by the camera, one for each pixel (Sintorn 2008, section 3, overview).

pub mod cast;
pub mod gbuffer;
pub mod import;
pub mod raster;
mod surface;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "view_samples",
    doc: "The surface points seen by the camera, one for each pixel (Sintorn 2008, section 3, overview).",
    ports: &[
        input::TRIANGLES.read(),
        input::CAMERA.read(),
        input::IMPORTED_POSITION.optional(),
        input::IMPORTED_NORMAL.optional(),
        input::IMPORTED_TRIANGLE.optional(),
        input::IMPORTED_PIXEL.optional(),
        ports::GBUFFER_POSITION.optional(),
        ports::GBUFFER_NORMAL.optional(),
        ports::GBUFFER_TRIANGLE.optional(),
        ports::POSITION,
        ports::NORMAL,
        ports::TRIANGLE,
        ports::PIXEL,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&raster::PASS, &cast::PASS, &import::PASS, &gbuffer::PASS];

/// Outputs of `count` view-samples.
fn shapes(count: usize) -> Vec<(&'static str, Vec<usize>)> {
    vec![
        (ports::POSITION.name, vec![count, 3]),
        (ports::NORMAL.name, vec![count, 3]),
        (ports::TRIANGLE.name, vec![count]),
        (ports::PIXEL.name, vec![count]),
    ]
}

/// One view-sample a pixel.
fn size_of_image(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    shapes(cx.image[0] * cx.image[1])
}

/// Shape of an optional input, if it is connected.
fn shape_if_connected<'a>(cx: &'a SizeCx, port: &str) -> Option<&'a [usize]> {
    cx.inputs.iter().find(|(name, _)| *name == port).map(|(_, shape)| shape.as_slice())
}
