//! The recipe: walk small casters, share out large ones.

use crate::shared::light_frame;
use crate::shared::share::{Queue, check_hard, record_share};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const KERNEL: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("../../shared/predicate.wgsl"),
    include_str!("../../shared/pyramid.wgsl"),
    include_str!("../../shared/footprint.wgsl"),
    include_str!("kernel.wgsl"),
];

/// Texels that one invocation of a caster shared by workgroups walks, at most, or one row.
const SHARE_TEXELS: usize = 16_384;
/// Queues of casters.
const QUEUES: usize = 2;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let triangle_count = cx.dim("triangles", 0);
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)];
    check_hard(cx)?;
    let queue = cx.scratch("binning_queue", QUEUES * face_count * triangle_count);
    let queued = cx.scratch("binning_queued", QUEUES);
    cx.zero(queued);
    cx.zero(Target::Port("caster_length"));
    let rows_each = (SHARE_TEXELS / side.max(1)).max(1);
    let shares = side.div_ceil(GROUP * rows_each).max(1) as u32;
    let bind = vec![
        Bind::Uniform(vec![triangle_count as u32, face_count as u32, side as u32, shares, 0]),
        Bind::Read(Target::Port("triangles")),
        Bind::Read(Target::Port("caster_state")),
        Bind::Read(Target::Port("light_samples")),
        Bind::Read(Target::Port("light_frame")),
        Bind::Read(Target::Port("list_length")),
        Bind::Read(Target::Port("list_far")),
        Bind::ReadWrite(Target::Port("pair_cell")),
        Bind::ReadWrite(Target::Port("pair_slot")),
        Bind::ReadWrite(Target::Port("pair_caster")),
        Bind::ReadWrite(Target::Port("caster_length")),
        Bind::ReadWrite(Target::Counters),
        Bind::ReadWrite(queue),
        Bind::ReadWrite(queued),
    ];
    cx.dispatch("binning", KERNEL, "binning", bind.clone(), triangle_count, GROUP);
    let rows = Queue { queued, word: 0, items: 8, groups: 1 };
    record_share(cx, "binning/rows", KERNEL, "binning_rows", bind.clone(), rows);
    record_share(
        cx,
        "binning/shares",
        KERNEL,
        "binning_shares",
        bind,
        Queue { word: 1, items: 1, groups: shares, ..rows },
    );
    Ok(())
}
