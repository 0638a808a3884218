//! One dispatch.

use crate::list_fill::LIST_OFFSET;
use crate::ports;
use crate::shared::table_fill::{WGSL, bindings};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] = &[PRELUDE, WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (count, cells) = (cx.dim(ports::CELL.name, 0), cx.words(LIST_OFFSET) - 1);
    let lists = [ports::CELL.name, ports::SLOT.name, LIST_OFFSET].map(Port);
    let mut bind = bindings(count, cells, count, lists[0], lists[1], lists[2]);
    bind.push(Bind::ReadWrite(Port(ports::LIST_ENTRIES.name)));
    cx.dispatch("list_fill/direct", PIECES, "direct", bind, count, GROUP);
    Ok(())
}
