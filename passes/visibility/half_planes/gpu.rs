//! The recipe: the shared join with all planes at every light sample.

use crate::shared::soft_record::{Join, record_soft};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::PRELUDE;

const KERNEL: &[&str] = &[
    PRELUDE,
    include_str!("../../shared/predicate.wgsl"),
    include_str!("../../shared/pyramid.wgsl"),
    include_str!("../../shared/soft_pair.wgsl"),
    include_str!("../../shared/soft_sides.wgsl"),
    include_str!("../../shared/soft_join.wgsl"),
    include_str!("../../shared/soft_batch.wgsl"),
    include_str!("kernel.wgsl"),
    include_str!("../../shared/soft_doubts.wgsl"),
];

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    record_soft(cx, Join { pieces: KERNEL, more: vec![Bind::ReadWrite(Target::Counters)] })
}
