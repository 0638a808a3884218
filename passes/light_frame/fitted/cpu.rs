//! Two reductions, in parallel.

use crate::ports;
use crate::shared::light_fit;
use crate::shared::light_frame::Face;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::FACE_WORDS;

/// The face, and how many kept view-samples it cannot place.
pub fn fitted(positions: &[[f32; 3]], states: &[u32], light_samples: &[[f32; 3]]) -> (Face, u64) {
    let origin = light_fit::origin(light_samples);
    let directions = light_fit::direction_bounds(origin, positions, states);
    let face = light_fit::look(origin, light_fit::middle(&directions));
    let (window, behind) = light_fit::window_bounds(&face, positions, states);
    (light_fit::fit(face, &window), behind)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let (face, behind) = fitted(
        cx.input(ports::POSITION.name).as_vec3(),
        cx.input(ports::SAMPLE_STATE.name).as_u32(),
        cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
    );
    cx.count(light_fit::BEHIND.name, behind);
    cx.put(ports::LIGHT_FRAME.name, Array::f32([1, FACE_WORDS], face.to_words().to_vec()));
    Ok(())
}
