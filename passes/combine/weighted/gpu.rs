//! One dispatch.

use super::check_weights;
use crate::combine::blocked::check_steps;
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] = &[PRELUDE, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (count, words) = (cx.dim(ports::SAMPLE_STATE.name, 0), cx.dim(ports::MASK.name, 1));
    let samples = cx.dim(input::LIGHT_WEIGHTS.name, 0);
    check_weights(samples, words)?;
    check_steps(samples + words)?;
    let bind = vec![
        Uniform(vec![count as u32, words as u32, samples as u32]),
        Read(Port(ports::MASK.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(input::LIGHT_WEIGHTS.name)),
        ReadWrite(Port(ports::VISIBLE.name)),
        ReadWrite(Port(ports::VISIBLE_COLOR.name)),
    ];
    cx.dispatch("combine/weighted", PIECES, "weighted", bind, count, GROUP);
    Ok(())
}
