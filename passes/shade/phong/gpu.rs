//! Background and surfaces.

use crate::shade::gpu;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::shared::PRELUDE;

/// Everything both kernels are made of.
pub const PIECES: &[&str] = &[
    PRELUDE,
    shading::WGSL,
    include_str!("../surface.wgsl"),
    include_str!("../background.wgsl"),
    include_str!("kernel.wgsl"),
];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let numbers = [super::SPECULAR, super::SHININESS].map(|spec| cx.params().f32(spec.name));
    gpu::record(cx, "shade/phong", PIECES, "phong", numbers, &[input::CAMERA.name]);
    Ok(())
}
