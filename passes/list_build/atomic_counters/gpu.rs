//! Counters to zero, then one dispatch.

use crate::list_build::{PLACE, SIZE};
use crate::ports;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::record::Target::{Counters, Port};
use shadowgraph_core::shared::GROUP;

const PIECES: &[&str] = &[PLACE[0], PLACE[1], PLACE[2], include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.dim(ports::POSITION.name, 0);
    let (faces, side) = (cx.dim(ports::LIGHT_FRAME.name, 0), cx.params().u32(SIZE.name));
    let cells = cx.words(ports::LIST_LENGTH.name);
    cx.zero(Port(ports::LIST_LENGTH.name));
    cx.zero(Port(ports::LIST_FAR.name));
    let bind = vec![
        Uniform(vec![count as u32, side, faces as u32, cells as u32]),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(ports::LIGHT_FRAME.name)),
        ReadWrite(Port(ports::CELL.name)),
        ReadWrite(Port(ports::SLOT.name)),
        ReadWrite(Port(ports::LIST_LENGTH.name)),
        ReadWrite(Port(ports::LIST_FAR.name)),
        ReadWrite(Counters),
    ];
    cx.dispatch("list_build/atomic_counters", PIECES, "atomic_counters", bind, count, GROUP);
    Ok(())
}
