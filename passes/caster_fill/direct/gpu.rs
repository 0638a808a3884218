//! One dispatch.

use crate::caster_fill::CASTER_OFFSET;
use crate::ports;
use crate::shared::table_fill::{WGSL, bindings};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] = &[PRELUDE, WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (capacity, cells) = (cx.dim(ports::PAIR_CELL.name, 0), cx.words(CASTER_OFFSET) - 1);
    let lists = [ports::PAIR_CELL.name, ports::PAIR_SLOT.name, CASTER_OFFSET].map(Port);
    let mut bind = bindings(capacity, cells, capacity, lists[0], lists[1], lists[2]);
    bind.push(Bind::Read(Port(ports::PAIR_CASTER.name)));
    bind.push(Bind::ReadWrite(Port(ports::CASTER_ENTRIES.name)));
    cx.dispatch("caster_fill/direct", PIECES, "direct", bind, capacity, GROUP);
    Ok(())
}
