//! Pass `view_samples/gbuffer`: view-samples from the textures that a host renders anyway.
//!
//! In: `gbuffer_position`, `gbuffer_normal [H W 4] f32, world, texture`, `gbuffer_triangle [H W] u32, texture`. Out, with
//! P = H W in row order from the top left: `position`, `normal [P 3] f32, world`, `triangle`, `pixel [P] u32`.
//!
//! A texel whose triangle has all bits set is background; its other outputs are zero. Words are copied as they are: the host
//! owes finite positions, unit geometric normals on the viewer's side, and triangles by their place in `triangles`.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::{shape_if_connected, shapes};
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::size::SizeCx;

/// A host's textures.
pub static PASS: Pass = Pass {
    name: "gbuffer",
    stage: &super::STAGE,
    doc: "Takes view-samples from a host's textures.",
    source: "Sintorn 2008, section 3, overview",
    ignores: &[
        input::TRIANGLES.name,
        input::CAMERA.name,
        input::IMPORTED_POSITION.name,
        input::IMPORTED_NORMAL.name,
        input::IMPORTED_TRIANGLE.name,
        input::IMPORTED_PIXEL.name,
    ],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    // Zero rows when it is not connected: the pass then says what is missing.
    shapes(shape_if_connected(cx, ports::GBUFFER_POSITION.name).map_or(0, |shape| shape[0] * shape[1]))
}

/// Height and width, from the shapes of the connected inputs.
///
/// # Errors
/// A texture that is missing, or textures of different sizes.
fn texture_size<'a>(shape: impl Fn(&'static str) -> Option<&'a [usize]>) -> Result<[usize; 2], Problem> {
    let mut first = None;
    for port in [ports::GBUFFER_POSITION, ports::GBUFFER_NORMAL, ports::GBUFFER_TRIANGLE] {
        let Some(shape) = shape(port.name) else {
            return Err(Problem::new(Kind::Missing, "the host's texture is not connected")
                .port(port.name)
                .expected(port.type_text())
                .remedy("bind the texture, or use view_samples raster"));
        };
        let size = [shape[0], shape[1]];
        let expected = *first.get_or_insert(size);
        if size != expected {
            return Err(Problem::new(Kind::PortMismatch, "the host's textures have different sizes")
                .port(port.name)
                .expected(format!("{} x {}", expected[1], expected[0]))
                .found(format!("{} x {}", size[1], size[0])));
        }
    }
    Ok(first.unwrap_or_default())
}
