//! The scan that other passes use too.

use crate::ports;
use crate::shared::scan;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let offsets = scan::exclusive(cx.input(ports::LENGTH.name).as_u32())?;
    cx.put(ports::OFFSET.name, Array::u32([offsets.len()], offsets));
    Ok(())
}
