//! View-samples in list order, packed for kernels that walk casters: the samples of a row of texels are one run of memory.

use crate::shared::light_frame;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PACK: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("predicate.wgsl"),
    include_str!("pyramid.wgsl"),
    include_str!("packed.wgsl"),
];
const UNPACK: &[&str] = &[PRELUDE, include_str!("unpack.wgsl")];

/// Scratch memory of one row a list entry.
#[derive(Clone, Copy, Debug)]
pub struct Packed {
    /// Four words: a `Sample` of pyramid.wgsl.
    pub sample: Target,
    /// One word, 0 at first; kernels write 1 where the light sample is blocked.
    pub blocked: Target,
}

/// Records the packing, and starts `mask`. Sets word `word + face` of `beyond`, zero before, where view-samples lie beyond the face's
/// window. Reads the ports of stage `visibility`.
pub fn record_pack(cx: &mut GpuCx, beyond: Target, word: usize) -> Packed {
    let sample_count = cx.dim("position", 0);
    let [cell_count, side] = [cx.words("list_length"), cx.dim("list_length", 1)];
    let packed =
        Packed { sample: cx.scratch("packed_sample", 4 * sample_count), blocked: cx.scratch("blocked", sample_count) };
    let bind = vec![
        Bind::Uniform(vec![sample_count as u32, cell_count as u32, side as u32, word as u32, 0]),
        Bind::Read(Target::Port("triangles")),
        Bind::Read(Target::Port("light_frame")),
        Bind::Read(Target::Port("light_samples")),
        Bind::Read(Target::Port("position")),
        Bind::Read(Target::Port("triangle")),
        Bind::Read(Target::Port("cell")),
        Bind::Read(Target::Port("list_offset")),
        Bind::Read(Target::Port("list_entries")),
        Bind::ReadWrite(packed.sample),
        Bind::ReadWrite(packed.blocked),
        Bind::ReadWrite(beyond),
        Bind::Read(Target::Port("sample_state")),
        Bind::ReadWrite(Target::Port("mask")),
    ];
    cx.dispatch("pack", PACK, "pack", bind, sample_count, GROUP);
    packed
}

/// Records the way back: `blocked` to `mask`.
pub fn record_unpack(cx: &mut GpuCx, packed: Packed) {
    let sample_count = cx.dim("position", 0);
    let bind = vec![
        Bind::Uniform(vec![sample_count as u32, cx.words("list_length") as u32]),
        Bind::Read(Target::Port("list_offset")),
        Bind::Read(Target::Port("list_entries")),
        Bind::Read(packed.blocked),
        Bind::ReadWrite(Target::Port("mask")),
    ];
    cx.dispatch("unpack", UNPACK, "unpack", bind, sample_count, GROUP);
}
