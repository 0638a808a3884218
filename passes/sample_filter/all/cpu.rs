//! The filter over slices.

use crate::ports;
use crate::sample_filter::CHUNK;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, KEPT, NO_TRIANGLE};

/// State of each view-sample.
pub fn keep_all(positions: &[[f32; 3]], triangles: &[u32]) -> Vec<u32> {
    let mut states = vec![BACKGROUND; positions.len()];
    let rows = states.par_chunks_mut(CHUNK).zip(positions.par_chunks(CHUNK)).zip(triangles.par_chunks(CHUNK));
    rows.for_each(|((states, positions), triangles)| {
        for ((state, position), triangle) in states.iter_mut().zip(positions).zip(triangles) {
            let finite = position.iter().all(|x| x.is_finite());
            *state = if *triangle != NO_TRIANGLE && finite { KEPT } else { BACKGROUND };
        }
    });
    states
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let positions = cx.input(ports::POSITION.name).as_vec3();
    let states = keep_all(positions, cx.input(ports::TRIANGLE.name).as_u32());
    cx.put(ports::SAMPLE_STATE.name, Array::u32([states.len()], states));
    Ok(())
}
