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
    let is_away = |light: DVec3, position: DVec3, normal: DVec3| normal.dot(light - position) <= 0.0;
    match lights[..] {
        [light] => states(positions, normals, triangles, |position, normal| is_away(light, position, normal)),
        _ => states(positions, normals, triangles, |position, normal| {
            lights.iter().all(|light| is_away(*light, position, normal))
        }),
    }
}

/// States where `is_away` of position and normal tells which face away; without branches, as neighbours often differ.
fn states(
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    triangles: &[u32],
    is_away: impl Fn(DVec3, DVec3) -> bool + Sync,
) -> Vec<u32> {
    let mut states = vec![BACKGROUND; positions.len()];
    let rows = states
        .par_chunks_mut(CHUNK)
        .zip(positions.par_chunks(CHUNK))
        .zip(normals.par_chunks(CHUNK).zip(triangles.par_chunks(CHUNK)));
    rows.for_each(|((states, positions), (normals, triangles))| {
        let samples = positions.iter().zip(normals).zip(triangles);
        for (state, ((position, normal), triangle)) in states.iter_mut().zip(samples) {
            let (position, normal) = (Vec3::from(*position), Vec3::from(*normal));
            let away = is_away(position.as_dvec3(), normal.as_dvec3());
            let seen = position.is_finite() & (*triangle != NO_TRIANGLE);
            *state = u32::from(seen) * (KEPT + (FACING_AWAY - KEPT) * u32::from(away));
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
