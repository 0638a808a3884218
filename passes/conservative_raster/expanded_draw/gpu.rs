//! The recipe.

use crate::shared::expand::record_pairs;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;

/// Half a texel: every texel touched has its centre in the grown outline.
const GROW: f32 = 0.5;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    record_pairs(cx, "expanded_draw", GROW, false)
}
