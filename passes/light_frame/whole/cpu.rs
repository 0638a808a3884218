//! Eight corners, and one reduction for depths and the count of what is behind.

use crate::ports;
use crate::shared::light_fit::{self, EMPTY, NEAREST};
use crate::shared::light_frame::{Face, project};
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::FACE_WORDS;

/// A face at `origin` over the box from `low` to `high`.
fn face_over(origin: Vec3, low: Vec3, high: Vec3) -> Face {
    let face = light_fit::look(origin, 0.5 * low + 0.5 * high - origin);
    let mut bounds = EMPTY;
    let mut all_in_front = true;
    for corner in 0..8 {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
        match project(&[face], Vec3::new(pick(0), pick(1), pick(2))) {
            Some(point) => bounds.add([point.u, point.v, point.depth]),
            None => all_in_front = false,
        }
    }
    if bounds.is_empty() {
        return face;
    }
    let nearest = NEAREST * bounds.high[2];
    if all_in_front {
        bounds.low[2] = bounds.low[2].max(nearest);
        return light_fit::fit(face, &bounds);
    }
    bounds.low[2] = nearest;
    light_fit::fit_depth(face, &bounds)
}

/// The face, and how many kept view-samples it cannot place.
pub fn whole(
    positions: &[[f32; 3]],
    states: &[u32],
    light_samples: &[[f32; 3]],
    scene_bounds: &[[f32; 3]],
) -> (Face, u64) {
    let mut face = face_over(light_fit::origin(light_samples), scene_bounds[0].into(), scene_bounds[1].into());
    let (window, behind) = light_fit::window_bounds(&face, positions, states);
    face.valid = !window.is_empty();
    if face.valid {
        let depths = light_fit::fit_depth(face, &window);
        (face.near, face.far) = (face.near.min(depths.near), face.far.max(depths.far));
    }
    (face, behind)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let (face, behind) = whole(
        cx.input(ports::POSITION.name).as_vec3(),
        cx.input(ports::SAMPLE_STATE.name).as_u32(),
        cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        cx.input(input::SCENE_BOUNDS.name).as_vec3(),
    );
    cx.count(light_fit::BEHIND.name, behind);
    cx.put(ports::LIGHT_FRAME.name, Array::f32([1, FACE_WORDS], face.to_words().to_vec()));
    Ok(())
}
