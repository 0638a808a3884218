//! Work that kernels leave to other kernels: queues on the device, and dispatches as large as they turned out.

use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, Command, Dispatch, GpuCx, Groups, Shader, Target};
use shadowgraph_core::shared::PRELUDE;

const SHARE: &[&str] = &[PRELUDE, include_str!("share.wgsl")];

/// A queue on the device, and how its items are taken.
#[derive(Clone, Copy, Debug)]
pub struct Queue {
    /// Buffer of queue lengths.
    pub queued: Target,
    /// Word of this queue's length.
    pub word: u32,
    /// Items a workgroup takes.
    pub items: u32,
    /// Workgroups that take one item together, along z.
    pub groups: u32,
}

/// Records a dispatch of `entry` over the items of `queue`: `workgroup_id.x + workgroup_id.y * 65,535` counts groups of items.
/// The kernel checks its item against the queue's length.
pub fn record_share(
    cx: &mut GpuCx,
    label: &'static str,
    pieces: &'static [&'static str],
    entry: &'static str,
    bind: Vec<Bind>,
    queue: Queue,
) {
    // Of its own: what an indirect dispatch reads may not be written by it.
    let groups = cx.scratch("share_groups", 3);
    let numbers = Bind::Uniform(vec![queue.items, queue.groups, queue.word]);
    let share = vec![numbers, Bind::Read(queue.queued), Bind::ReadWrite(groups)];
    cx.dispatch("share", SHARE, "share", share, 1, 1);
    let shader = Shader { pieces, constants: Vec::new() };
    let groups = Groups::Indirect(groups, 0);
    cx.push(Command::Dispatch(Dispatch { label, shader, entry, bind, groups }));
}

/// Triangles that kernels can tell apart in a packed view-sample.
const MOST_TRIANGLES: usize = 0xff_ffff;

/// Refuses what the kernels of hard shadows cannot take: other than one light sample, or too many triangles.
///
/// # Errors
/// Names the port, what it may hold, and the remedy.
pub fn check_hard(cx: &GpuCx) -> Result<(), Problem> {
    let light_count = cx.dim("light_samples", 0);
    if light_count != 1 {
        return Err(Problem::new(Kind::BadValue, "a hard shadow has one light sample")
            .port("light_samples")
            .expected("1 light sample")
            .found(format!("{light_count} light samples"))
            .remedy("use a graph for soft shadows, or one light sample"));
    }
    let triangle_count = cx.dim("triangles", 0);
    if triangle_count >= MOST_TRIANGLES {
        return Err(Problem::new(Kind::Unsupported, "more triangles than this recipe can number")
            .port("triangles")
            .expected(format!("fewer than {MOST_TRIANGLES}"))
            .found(triangle_count.to_string())
            .remedy("run this node on the CPU backend"));
    }
    Ok(())
}
