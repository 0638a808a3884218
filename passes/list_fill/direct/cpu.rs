//! The table of view-samples.

use crate::list_fill::LIST_OFFSET;
use crate::ports;
use crate::shared::table_fill::fill;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let (cells, slots) = (cx.input(ports::CELL.name).as_u32(), cx.input(ports::SLOT.name).as_u32());
    let offsets = cx.input(LIST_OFFSET).as_u32();
    let entries = fill(cells, slots, offsets, cells.len(), |view_sample| view_sample as u32);
    cx.put(ports::LIST_ENTRIES.name, Array::u32([entries.len()], entries));
    Ok(())
}
