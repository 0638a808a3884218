//! 0 or 1 a view-sample.

use crate::combine::blocked;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// 0 when `count` of `samples` are at least half.
pub fn half(count: u32, samples: u32) -> f32 {
    if count >= samples - count { 0.0 } else { 1.0 }
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    blocked::combine(cx, half);
    Ok(())
}
