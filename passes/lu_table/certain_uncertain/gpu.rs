//! The recipe: the layout, then a row an invocation.

use crate::shared::lu_record::record_lu;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::shared::PRELUDE;

const KERNEL: &[&str] = &[PRELUDE, include_str!("../../shared/lu_fill.wgsl"), include_str!("kernel.wgsl")];

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    record_lu(cx, KERNEL, false)
}
