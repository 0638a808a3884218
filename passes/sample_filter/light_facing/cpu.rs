//! The filter over slices, in f64.

use crate::ports;
use crate::sample_filter::CHUNK;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_TRIANGLE};

/// State of each view-sample.
pub fn light_facing(
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    triangles: &[u32],
    light_samples: &[[f32; 3]],
) -> Vec<u32> {
    let lights: Vec<DVec3> = light_samples.iter().map(|sample| Vec3::from(*sample).as_dvec3()).collect();
    let mut states = vec![BACKGROUND; positions.len()];
    let rows = states
        .par_chunks_mut(CHUNK)
        .zip(positions.par_chunks(CHUNK))
        .zip(normals.par_chunks(CHUNK).zip(triangles.par_chunks(CHUNK)));
    rows.for_each(|((states, positions), (normals, triangles))| {
        for index in 0..states.len() {
            let position = Vec3::from(positions[index]).as_dvec3();
            let normal = Vec3::from(normals[index]).as_dvec3();
            let away = lights.iter().all(|light| normal.dot(*light - position) <= 0.0);
            let seen = triangles[index] != NO_TRIANGLE && position.is_finite();
            let state = if away { FACING_AWAY } else { KEPT };
            states[index] = if seen { state } else { BACKGROUND };
        }
    });
    states
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let states = light_facing(
        cx.input(ports::POSITION.name).as_vec3(),
        cx.input(ports::NORMAL.name).as_vec3(),
        cx.input(ports::TRIANGLE.name).as_u32(),
        cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
    );
    cx.put(ports::SAMPLE_STATE.name, Array::u32([states.len()], states));
    Ok(())
}
