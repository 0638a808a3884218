//! The table of casters.

use crate::caster_fill::CASTER_OFFSET;
use crate::ports;
use crate::shared::table_fill::fill;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let [cells, slots, casters] =
        [ports::PAIR_CELL.name, ports::PAIR_SLOT.name, ports::PAIR_CASTER.name].map(|port| cx.input(port).as_u32());
    let offsets = cx.input(CASTER_OFFSET).as_u32();
    let pairs = cells.len().min(offsets[offsets.len() - 1] as usize);
    let entries = fill(&cells[..pairs], &slots[..pairs], offsets, cells.len(), |pair| casters[pair]);
    cx.put(ports::CASTER_ENTRIES.name, Array::u32([entries.len()], entries));
    Ok(())
}
