//! Ones.

use crate::ports;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let count = cx.input(input::TRIANGLES.name).dim(0);
    cx.put(ports::CASTER_STATE.name, Array::u32([count], vec![1; count]));
    Ok(())
}
