//! One dispatch.

use crate::ports;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.dim(ports::POSITION.name, 0);
    let bind = vec![
        Uniform(vec![count as u32, 0, 0, 0]),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::TRIANGLE.name)),
        ReadWrite(Port(ports::SAMPLE_STATE.name)),
    ];
    cx.dispatch("sample_filter/all", &[PRELUDE, include_str!("kernel.wgsl")], "all_samples", bind, count, GROUP);
    Ok(())
}
