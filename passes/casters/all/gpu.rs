//! One dispatch.

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.dim(input::TRIANGLES.name, 0);
    let bind = vec![Uniform(vec![count as u32, 0, 0, 0]), ReadWrite(Port(ports::CASTER_STATE.name))];
    cx.dispatch("casters/all", &[PRELUDE, include_str!("kernel.wgsl")], "all_casters", bind, count, GROUP);
    Ok(())
}
