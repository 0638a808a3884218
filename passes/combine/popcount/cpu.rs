//! A fraction a view-sample.

use crate::combine::blocked;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// Share of `samples` that `count` blocked ones leave.
pub fn fraction(count: u32, samples: u32) -> f32 {
    (samples - count) as f32 / samples as f32
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    blocked::combine(cx, fraction);
    Ok(())
}
