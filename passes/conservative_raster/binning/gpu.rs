//! The recipe: walk small casters, share out large ones.

use crate::shared::light_frame;
use crate::shared::pair_walk_gpu::{self, Kernel, Queues, Table, record_walk};
use crate::shared::share::check_hard;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{GpuCx, Target};
use shadowgraph_core::shared::PRELUDE;

const KERNEL: Kernel = Kernel {
    pieces: &[
        PRELUDE,
        light_frame::WGSL,
        include_str!("../../shared/predicate.wgsl"),
        include_str!("../../shared/pyramid.wgsl"),
        include_str!("../../shared/footprint.wgsl"),
        pair_walk_gpu::WGSL,
        include_str!("kernel.wgsl"),
    ],
    entries: ["binning", "binning_rows", "binning_shares"],
    labels: ["binning", "binning/rows", "binning/shares"],
    sources: &[Target::Port("triangles"), Target::Port("light_samples")],
};

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    check_hard(cx)?;
    let caster_count = cx.dim("triangles", 0);
    let table = Table::pairs(cx);
    let queues = Queues::new(cx, &table, caster_count);
    record_walk(cx, KERNEL, &table, queues, 0..caster_count);
    Ok(())
}
