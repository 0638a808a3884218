//! One dispatch.

use crate::combine::blocked::{WGSL, record_combine};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::shared::PRELUDE;

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    record_combine(cx, "combine/threshold", &[PRELUDE, WGSL, include_str!("kernel.wgsl")], "threshold")
}
