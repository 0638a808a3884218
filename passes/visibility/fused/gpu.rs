//! The recipe: pack the view-samples, test small casters, share out large ones, decide what is doubtful.

use crate::shared::light_frame;
use crate::shared::packed::{record_pack, record_unpack};
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

/// View-samples that one invocation of a shared caster tests at most; `ROW_SAMPLES` in the kernel.
const ROW_SAMPLES: usize = 2048;
/// Queues of casters.
const QUEUES: usize = 4;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let triangle_count = cx.dim("triangles", 0);
    let sample_count = cx.dim("position", 0);
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)];
    check_hard(cx)?;
    let queue = cx.scratch("fused_queue", QUEUES * face_count * triangle_count);
    let queued = cx.scratch("fused_queued", QUEUES + face_count);
    cx.zero(queued);
    let packed = record_pack(cx, queued, QUEUES);
    let shares = sample_count.div_ceil(GROUP * ROW_SAMPLES).max(1) as u32;
    let bind = vec![
        Bind::Uniform(vec![triangle_count as u32, face_count as u32, side as u32, shares, 0]),
        Bind::Read(Target::Port("triangles")),
        Bind::Read(Target::Port("caster_state")),
        Bind::Read(Target::Port("light_frame")),
        Bind::Read(Target::Port("light_samples")),
        Bind::Read(Target::Port("list_offset")),
        Bind::Read(Target::Port("list_entries")),
        Bind::Read(Target::Port("position")),
        Bind::Read(Target::Port("triangle")),
        Bind::Read(packed.sample),
        Bind::ReadWrite(packed.blocked),
        Bind::ReadWrite(queue),
        Bind::ReadWrite(queued),
        Bind::ReadWrite(Target::Counters),
    ];
    cx.dispatch("fused", KERNEL, "fused", bind.clone(), triangle_count, GROUP);
    let rows = Queue { queued, word: 0, items: 8, groups: 1 };
    for (label, entry, queue) in [
        ("fused/rows", "fused_rows", rows),
        ("fused/shares", "fused_shares", Queue { word: 1, items: 1, groups: shares, ..rows }),
        ("fused/row_doubts", "fused_row_doubts", Queue { word: 2, items: 1, ..rows }),
        ("fused/share_doubts", "fused_share_doubts", Queue { word: 3, items: 1, groups: shares, ..rows }),
    ] {
        record_share(cx, label, KERNEL, entry, bind.clone(), queue);
    }
    record_unpack(cx, packed);
    Ok(())
}
