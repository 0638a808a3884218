//! A copy: on the CPU a texture is an array.

use super::IMAGE_TEXTURE;
use crate::ports;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let image = cx.input(ports::IMAGE.name).clone();
    cx.put(IMAGE_TEXTURE, image);
    Ok(())
}
