//! The recipe: planes of every caster, test every view-sample, share out long cells, decide what is doubtful.

use crate::shared::share::{Queue, check_hard, record_share};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const KERNEL: &[&str] = &[
    PRELUDE,
    include_str!("../../shared/predicate.wgsl"),
    include_str!("../../shared/pyramid.wgsl"),
    include_str!("kernel.wgsl"),
];

/// Casters that one invocation tests, at most; `OWN_CASTERS` in the kernel.
const OWN_CASTERS: usize = 2048;
/// Queues of view-samples.
const QUEUES: usize = 3;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    check_hard(cx)?;
    let sample_count = cx.dim("position", 0);
    let triangle_count = cx.dim("triangles", 0);
    // A cell lists each triangle once.
    let shares = triangle_count.div_ceil(GROUP * OWN_CASTERS).max(1) as u32;
    // A binding holds one row at least.
    let rows = triangle_count.max(1);
    let sides = cx.scratch("planes_sides", 12 * rows);
    let fronts = cx.scratch("planes_fronts", 8 * rows);
    let queue = cx.scratch("planes_queue", QUEUES * sample_count);
    let queued = cx.scratch("planes_queued", QUEUES);
    cx.zero(queued);
    let bind = vec![
        Bind::Uniform(vec![triangle_count as u32, sample_count as u32, shares, 0]),
        Bind::Read(Target::Port("triangles")),
        Bind::Read(Target::Port("caster_state")),
        Bind::Read(Target::Port("light_samples")),
        Bind::Read(Target::Port("position")),
        Bind::Read(Target::Port("triangle")),
        Bind::Read(Target::Port("sample_state")),
        Bind::Read(Target::Port("cell")),
        Bind::Read(Target::Port("caster_offset")),
        Bind::Read(Target::Port("caster_entries")),
        Bind::ReadWrite(Target::Port("mask")),
        Bind::ReadWrite(queue),
        Bind::ReadWrite(queued),
        Bind::ReadWrite(Target::Counters),
        Bind::ReadWrite(sides),
        Bind::ReadWrite(fronts),
    ];
    cx.dispatch("planes/casters", KERNEL, "planes_casters", bind.clone(), triangle_count, GROUP);
    cx.dispatch("planes", KERNEL, "planes", bind.clone(), sample_count, GROUP);
    let long = Queue { queued, word: 0, items: 1, groups: shares };
    for (label, entry, queue) in [
        ("planes/long", "planes_long", long),
        ("planes/doubts", "planes_doubts", Queue { word: 1, items: GROUP as u32, groups: 1, ..long }),
        ("planes/long_doubts", "planes_long_doubts", Queue { word: 2, ..long }),
    ] {
        record_share(cx, label, KERNEL, entry, bind.clone(), queue);
    }
    Ok(())
}

#[test]
fn the_kernel_states_the_same_number_of_casters() {
    assert!(include_str!("kernel.wgsl").contains(&format!("const OWN_CASTERS: u32 = {OWN_CASTERS}u;")));
}
