//! The recipe: the shared join with look-ups.

use super::FORM;
use crate::shared::lu::missing_layout;
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
    include_str!("../../shared/lu.wgsl"),
    include_str!("kernel.wgsl"),
    include_str!("../../shared/soft_doubts.wgsl"),
];

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let shape = cx.is_connected("lu").then(|| cx.shape("lu").to_vec());
    FORM.check(shape.as_deref())?;
    if !cx.is_connected("lu_layout") {
        return Err(missing_layout());
    }
    let size = cx.dim("lu", 1) as u32;
    let more = vec![
        Bind::Read(Target::Port("lu")),
        Bind::Read(Target::Port("lu_layout")),
        Bind::Uniform(vec![size]),
        Bind::ReadWrite(Target::Counters),
    ];
    record_soft(cx, Join { pieces: KERNEL, more })
}
