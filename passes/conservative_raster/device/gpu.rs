//! The recipe.

use crate::shared::expand::record_pairs;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    record_pairs(cx, "device", 0.0, true)
}
