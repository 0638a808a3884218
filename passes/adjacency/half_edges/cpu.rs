//! One sort around every corner.

use crate::ports;
use crate::shared::neighbours::{NONE, Neighbours};
use crate::shared::predicate::Corners;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let triangles: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let caster_state = cx.input(ports::CASTER_STATE.name).as_u32();
    let across = Neighbours::new(triangles, |id| caster_state[id] != 0).into_rows();
    let open = across.iter().zip(caster_state).filter(|(_, state)| **state != 0);
    let open = open.flat_map(|(row, _)| row).filter(|other| **other == NONE).count();
    cx.count("open_edges", open as u64);
    cx.put(ports::ACROSS.name, Array::u32([across.len(), 3], across.into_flattened()));
    Ok(())
}
