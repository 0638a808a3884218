//! One dispatch.

use crate::ports;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// Everything the kernel is made of.
pub const PIECES: &[&str] = &[PRELUDE, shading::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let corners = cx.words(ports::CORNER_LIGHT.name);
    let bind = vec![
        Uniform(vec![corners as u32]),
        Read(Port(input::TRIANGLES.name)),
        Read(Port(input::LIGHT.name)),
        ReadWrite(Port(ports::CORNER_LIGHT.name)),
    ];
    cx.dispatch("bent_light/own_face", PIECES, "own_face", bind, corners, GROUP);
    Ok(())
}
