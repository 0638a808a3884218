//! One reduction with bounds for every face.

use super::{BEHIND, FACES};
use crate::ports;
use crate::shared::light_fit::{self, Bounds};
use crate::shared::light_frame::Face;
use glam::{Vec3, Vec4};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::FACE_WORDS;

/// Index of the face's world axis, and of those of its x and y: for a face looking up an axis the two that follow it, for one
/// looking down the same two swapped, so that both are right-handed.
#[inline]
fn axes(face: usize) -> [usize; 3] {
    let axis = face / 2;
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    if face.is_multiple_of(2) { [axis, next, last] } else { [axis, last, next] }
}

/// Whole cube faces around `origin`, without view-samples.
pub fn cube(origin: Vec3) -> [Face; FACES] {
    std::array::from_fn(|face| {
        let [axis, axis_x, axis_y] = axes(face);
        let mut axis_z = Vec3::ZERO;
        axis_z[axis] = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
        Face {
            origin,
            valid: false,
            axis_x: Vec3::AXES[axis_x],
            axis_y: Vec3::AXES[axis_y],
            axis_z,
            window_low: [-1.0; 2],
            window_size: [2.0; 2],
            near: 1.0,
            far: 2.0,
        }
    })
}

/// Bounds of (u, v, depth) on each face of the cube, and the number of kept view-samples at `origin`.
fn cube_bounds(origin: Vec3, positions: &[[f32; 3]], states: &[u32]) -> ([Bounds; FACES], u64) {
    light_fit::reduce(origin, positions, states, |offset| {
        let [x, y, z] = offset.map(Vec4::abs);
        let largest = x.max(y).max(z);
        std::array::from_fn(|face| {
            let [axis, axis_x, axis_y] = axes(face);
            let depth = if face.is_multiple_of(2) { offset[axis] } else { -offset[axis] };
            // Of equals the lowest face takes the lane: later ones get what is left.
            let member = depth.cmpge(largest) & depth.cmpgt(Vec4::ZERO);
            ([offset[axis_x] / depth, offset[axis_y] / depth, depth], member)
        })
    })
}

/// The faces, and how many kept view-samples none of them can place.
pub fn six_faces(
    positions: &[[f32; 3]],
    states: &[u32],
    light_samples: &[[f32; 3]],
    fit: bool,
) -> ([Face; FACES], u64) {
    let origin = light_fit::origin(light_samples);
    let (bounds, behind) = cube_bounds(origin, positions, states);
    let mut faces = cube(origin);
    for (face, bounds) in faces.iter_mut().zip(&bounds).filter(|(_, bounds)| !bounds.is_empty()) {
        let fitted = light_fit::fit(*face, bounds);
        let whole = Face { window_low: face.window_low, window_size: face.window_size, ..fitted };
        *face = if fit { fitted } else { whole };
    }
    (faces, behind)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let (faces, behind) = six_faces(
        cx.input(ports::POSITION.name).as_vec3(),
        cx.input(ports::SAMPLE_STATE.name).as_u32(),
        cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        cx.params().bool("fit"),
    );
    cx.count(BEHIND.name, behind);
    let words = faces.iter().flat_map(Face::to_words).collect();
    cx.put(ports::LIGHT_FRAME.name, Array::f32([FACES, FACE_WORDS], words));
    Ok(())
}
