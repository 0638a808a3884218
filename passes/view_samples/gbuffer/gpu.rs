//! One dispatch.

use super::texture_size;
use crate::ports;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{ReadWrite, Texture, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let [height, width] = texture_size(|name| cx.is_connected(name).then(|| cx.shape(name)))?;
    let count = width * height;
    let bind = vec![
        Uniform(vec![count as u32, width as u32, 0, 0]),
        Texture(Port(ports::GBUFFER_POSITION.name)),
        Texture(Port(ports::GBUFFER_NORMAL.name)),
        Texture(Port(ports::GBUFFER_TRIANGLE.name)),
        ReadWrite(Port(ports::POSITION.name)),
        ReadWrite(Port(ports::NORMAL.name)),
        ReadWrite(Port(ports::TRIANGLE.name)),
        ReadWrite(Port(ports::PIXEL.name)),
    ];
    cx.dispatch("view_samples/gbuffer", &[PRELUDE, include_str!("kernel.wgsl")], "gbuffer", bind, count, GROUP);
    Ok(())
}
