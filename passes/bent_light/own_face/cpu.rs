//! One cosine a corner.

use crate::ports;
use crate::shared::shading::{Corners, face_cosine};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// `[T, 3]` cosines.
pub fn cosines(triangles: &[Corners], light: Vec3) -> Vec<[f32; 3]> {
    triangles.par_iter().map(|corners| corners.map(|corner| face_cosine(corners, corner, light))).collect()
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let triangles = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let cosines = cosines(triangles, super::super::centre(cx.input(input::LIGHT.name)));
    cx.put(ports::CORNER_LIGHT.name, Array::f32([cosines.len(), 3], bytemuck::cast_vec(cosines)));
    Ok(())
}
