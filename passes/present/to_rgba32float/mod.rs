//! Pass `present/to_rgba32float`: the picture as a texture of four floats a texel, word for word, for a host to composite.
//!
//! In: `image [H W 4] f32, image`. Out: `image_texture [H W 4] f32, image`, a texture on the GPU.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::size::SizeCx;

/// The output's name at the stage.
const IMAGE_TEXTURE: &str = "image_texture";

/// A copy.
pub static PASS: Pass = Pass {
    name: "to_rgba32float",
    stage: &super::STAGE,
    doc: "Copies the picture to a texture of four floats a texel.",
    source: "none: a means of composition",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let image = ports::IMAGE.name;
    vec![(IMAGE_TEXTURE, vec![cx.dim(image, 0), cx.dim(image, 1), cx.dim(image, 2)])]
}
