//! The exact side of every triangle.

use crate::ports;
use crate::shared::predicate::{Corners, side};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::flag;

/// Triangles one task takes.
const CHUNK: usize = 1 << 12;

/// Whether the triangle casts: not of a closed mesh, or some light sample is strictly behind it (where its corners are
/// seen clockwise, which is the positive side of `orient3d`).
pub fn casts(corners: &Corners, flags: u32, samples: &[[f32; 3]]) -> bool {
    flags & flag::CLOSED == 0 || samples.iter().any(|sample| side(corners, *sample) > 0)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let triangles: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let flags = cx.input(input::TRIANGLE_FLAGS.name).as_u32();
    let samples = cx.input(input::LIGHT_SAMPLES.name).as_vec3();
    let state = |(corners, flags): (&Corners, &u32)| u32::from(casts(corners, *flags, samples));
    let states: Vec<u32> = triangles.par_iter().zip(flags).with_min_len(CHUNK).map(state).collect();
    cx.count("culled", states.len() as u64 - states.iter().map(|state| u64::from(*state)).sum::<u64>());
    cx.put(ports::CASTER_STATE.name, Array::u32([states.len()], states));
    Ok(())
}
