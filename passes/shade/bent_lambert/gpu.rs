//! Background and surfaces.

use crate::ports;
use crate::shade::gpu;
use crate::shared::shading;
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
    let numbers = [cx.params().f32(super::SHARPNESS.name), 0.0];
    gpu::record(cx, "shade/bent_lambert", PIECES, "bent_lambert", numbers, &[ports::CORNER_LIGHT.name]);
    Ok(())
}
