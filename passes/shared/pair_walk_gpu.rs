//! The recipe of a walk over casters' regions: small ones by an invocation each, the rest through queues.

use crate::shared::share::{Queue, record_share};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::GROUP;
use std::ops::Range;

/// The walk in WGSL; see there for what a kernel gives it.
pub const WGSL: &str = include_str!("pair_walk.wgsl");

/// Texels that one invocation of a caster shared by workgroups walks, at most, or one row.
const SHARE_TEXELS: usize = 16_384;
/// Queues of casters.
const QUEUES: usize = 2;

/// A kernel that makes regions.
#[derive(Clone, Copy, Debug)]
pub struct Kernel<'a> {
    /// Its WGSL, [`WGSL`] among it.
    pub pieces: &'static [&'static str],
    /// Entry points: one invocation a caster, rows, shares.
    pub entries: [&'static str; 3],
    /// Labels of these.
    pub labels: [&'static str; 3],
    /// Bound from 12 on: what the kernel makes casters and regions of.
    pub sources: &'a [Target],
}

/// What is walked, and where its pairs go.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// How many casters there are.
    pub caster_count: usize,
    /// 0 for each that is left out.
    pub caster_state: Target,
    /// Cells, slots and casters of pairs: those past the room there is are counted, not kept.
    pub pairs: [Target; 3],
    /// Casters of each cell, which the walk starts from zero.
    pub caster_length: Target,
    /// Two words: pairs, and pairs left out.
    pub counters: Target,
}

impl Table {
    /// The table of stage `conservative_raster`.
    pub fn pairs(cx: &GpuCx) -> Self {
        Self {
            caster_count: cx.dim("triangles", 0),
            caster_state: Target::Port("caster_state"),
            pairs: ["pair_cell", "pair_slot", "pair_caster"].map(Target::Port),
            caster_length: Target::Port("caster_length"),
            counters: Target::Counters,
        }
    }
}

/// Memory of a walk, for so many casters at a time.
#[derive(Clone, Copy, Debug)]
pub struct Queues {
    queue: Target,
    queued: Target,
}

impl Queues {
    /// Room for `caster_count` casters on every face; forgets all pairs.
    pub fn new(cx: &mut GpuCx, table: &Table, caster_count: usize) -> Self {
        let queue = cx.scratch("walk_queue", QUEUES * cx.dim("list_length", 0) * caster_count);
        let queued = cx.scratch("walk_queued", QUEUES);
        cx.zero(table.caster_length);
        Self { queue, queued }
    }
}

/// Records `kernel` over `casters` of `table`.
pub fn record_walk(cx: &mut GpuCx, kernel: Kernel, table: &Table, queues: Queues, casters: Range<usize>) {
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)];
    let Queues { queue, queued } = queues;
    cx.zero(queued);
    let rows_each = (SHARE_TEXELS / side.max(1)).max(1);
    let shares = side.div_ceil(GROUP * rows_each).max(1) as u32;
    let [first, count] = [casters.start, casters.len()].map(|number| number as u32);
    let numbers = vec![table.caster_count as u32, face_count as u32, side as u32, shares, 0, first, count];
    let [frame, length, far] = ["light_frame", "list_length", "list_far"].map(Target::Port);
    let read = [table.caster_state, frame, length, far];
    let written = table.pairs.into_iter().chain([table.caster_length, table.counters, queue, queued]);
    let bind: Vec<Bind> = std::iter::once(Bind::Uniform(numbers))
        .chain(read.map(Bind::Read))
        .chain(written.map(Bind::ReadWrite))
        .chain(kernel.sources.iter().copied().map(Bind::Read))
        .collect();
    let [entry, entry_rows, entry_shares] = kernel.entries;
    let [label, label_rows, label_shares] = kernel.labels;
    cx.dispatch(label, kernel.pieces, entry, bind.clone(), casters.len(), GROUP);
    let rows = Queue { queued, word: 0, items: 8, groups: 1 };
    record_share(cx, label_rows, kernel.pieces, entry_rows, bind.clone(), rows);
    let shared = Queue { word: 1, items: 1, groups: shares, ..rows };
    record_share(cx, label_shares, kernel.pieces, entry_shares, bind, shared);
}
