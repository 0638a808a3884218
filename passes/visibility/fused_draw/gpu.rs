//! The recipe: pack the view-samples, draw the casters face by face.

use crate::shared::expand::{FAN_WGSL, FanDraw, record_fans};
use crate::shared::packed::record_pack;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::PRELUDE;

const KERNEL: &[&str] = &[
    PRELUDE,
    include_str!("../../shared/predicate.wgsl"),
    include_str!("../../shared/pyramid.wgsl"),
    FAN_WGSL,
    include_str!("kernel.wgsl"),
];

/// Half a texel: every texel touched has its centre in the grown outline.
const GROW: f32 = 0.5;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let face_count = cx.dim("list_length", 0);
    let side = cx.dim("list_length", 1) as u32;
    let beyond = cx.scratch("fused_draw_beyond", face_count);
    cx.zero(beyond);
    let packed = record_pack(cx, beyond, 0);
    let draw = FanDraw {
        label: "fused_draw",
        pieces: KERNEL,
        fragment: "fused_draw",
        grow: GROW,
        conservative: false,
        beyond: Some(beyond),
    };
    record_fans(cx, draw, |fans, face| {
        vec![
            Bind::Uniform(vec![face, side, 0]),
            Bind::Read(fans),
            Bind::Read(Target::Port("triangles")),
            Bind::Read(Target::Port("light_samples")),
            Bind::Read(Target::Port("list_far")),
            Bind::Read(Target::Port("list_offset")),
            Bind::Read(Target::Port("list_entries")),
            Bind::Read(Target::Port("position")),
            Bind::Read(Target::Port("triangle")),
            Bind::Read(packed.sample),
            Bind::ReadWrite(Target::Port("mask")),
            Bind::ReadWrite(Target::Counters),
        ]
    })
}
