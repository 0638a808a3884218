//! The recipe: the shared join with look-ups.

use super::FORM;
use crate::shared::lu_look_up::{pieces, record_look_up};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;

const KERNEL: &[&str] = &pieces(include_str!("kernel.wgsl"));

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    record_look_up(cx, FORM, KERNEL)
}
