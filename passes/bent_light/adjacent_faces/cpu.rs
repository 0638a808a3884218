//! The smallest cosine around each vertex, then at each corner.

use crate::ports;
use crate::shared::shading::{Corners, face_normal, unit};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// Above every cosine: nothing counted yet.
const NONE: f32 = 2.0;

/// The cosine of a face at a corner, or [`NONE`] if it has no normal.
fn cosine(corners: &Corners, corner: usize, light: Vec3) -> f32 {
    let normal = face_normal(corners);
    if normal == Vec3::ZERO { NONE } else { unit(light - Vec3::from(corners[corner])).dot(normal) }
}

/// `[T, 3]` smallest cosines.
pub fn smallest(
    triangles: &[Corners],
    corner_vertex: &[[u32; 3]],
    face_offset: &[u32],
    faces: &[u32],
    light: Vec3,
) -> Vec<[f32; 3]> {
    let around = |vertex: usize| {
        let row = face_offset[vertex] as usize..face_offset[vertex + 1] as usize;
        let listed = faces.get(row).unwrap_or(&[]).iter().filter_map(|&face| {
            let corner = corner_vertex.get(face as usize)?.iter().position(|&v| v as usize == vertex)?;
            Some(cosine(&triangles[face as usize], corner, light))
        });
        listed.fold(NONE, f32::min)
    };
    let vertices: Vec<f32> = (0..face_offset.len().saturating_sub(1)).into_par_iter().map(around).collect();
    let at_corner = |(corners, of): (&Corners, &[u32; 3])| {
        [0, 1, 2].map(|k| {
            let least = vertices.get(of[k] as usize).copied().unwrap_or(NONE).min(cosine(corners, k, light));
            if least == NONE { 0.0 } else { least }
        })
    };
    triangles.par_iter().zip(corner_vertex).map(at_corner).collect()
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let smallest = smallest(
        bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32()),
        bytemuck::cast_slice(cx.input(input::CORNER_VERTEX.name).as_u32()),
        cx.input(input::FACE_OFFSET.name).as_u32(),
        cx.input(input::FACES.name).as_u32(),
        super::super::centre(cx.input(input::LIGHT.name)),
    );
    cx.put(ports::CORNER_LIGHT.name, Array::f32([smallest.len(), 3], bytemuck::cast_vec(smallest)));
    Ok(())
}
