//! One rasterisation for each face.

use crate::ports;
use crate::shared::light_frame::faces;
use crate::shared::shadow_raster::{CLEAR, draw};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// `[F, side, side]` depths of the nearest casters.
pub fn nearest(frame: &[f32], side: usize, triangles: &[[[f32; 3]; 3]], caster_state: &[u32]) -> Vec<f32> {
    let faces = faces(frame);
    let mut depth = vec![CLEAR; faces.len() * side * side];
    for (face, layer) in faces.iter().zip(depth.chunks_exact_mut(side * side)) {
        draw(face, side, triangles, caster_state, layer, |_, _| true);
    }
    depth
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let side = cx.params().u32(super::super::SIZE.name) as usize;
    let frame = cx.input(ports::LIGHT_FRAME.name);
    let triangles = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let depth = nearest(frame.as_f32(), side, triangles, cx.input(ports::CASTER_STATE.name).as_u32());
    cx.put(ports::DEPTH.name, super::super::depth_array(frame.dim(0), side, depth));
    Ok(())
}
