//! Three dispatches for all faces, then for each range a depth-only draw a face and one dispatch.

use super::{SIZE, at_once, ranges};
use crate::ports;
use crate::shared::light_fit::{self, FIT_WORDS};
use crate::shared::{light_frame, shadow_lookup, shadow_map, shadow_raster};
use shadowgraph_core::input;
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Texture, Uniform};
use shadowgraph_core::record::Target::{Counters, Port};
use shadowgraph_core::record::{Command, Cull, DepthTarget, Draw, GpuCx, Shader, Target};
use shadowgraph_core::shared::{FACE_WORDS, GROUP, PRELUDE};

const FRAMES: &[&str] = &[PRELUDE, light_frame::WGSL, light_fit::WGSL, include_str!("frames.wgsl")];
const DRAW: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    shadow_map::WGSL,
    include_str!("../../shared/shadow_vertex.wgsl"),
    include_str!("draw.wgsl"),
];
const COMPARE: &[&str] =
    &[PRELUDE, light_frame::WGSL, shadow_map::WGSL, shadow_lookup::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let side = shadow_map::side_on_device(cx, SIZE.name)?;
    let (light_count, face_count) = (cx.dim(input::LIGHT_SAMPLES.name, 0), cx.dim(ports::LIGHT_FRAME.name, 0));
    let at_once = at_once(cx.params(), face_count);
    let frames = record_frames(cx, light_count, face_count);
    let layers = face_count * at_once.min(light_count.max(1));
    let maps = cx.scratch_texture("maps", Storage::DepthTexture, vec![layers, side as usize, side as usize]);
    for range in ranges(light_count, at_once) {
        for (layer, face) in (range.start * face_count..range.end * face_count).enumerate() {
            draw(cx, frames, maps, side, face as u32, layer as u32);
        }
        compare(cx, frames, maps, side, [range.start, range.end]);
    }
    Ok(())
}

/// Scratch words of the faces of all light samples.
fn record_frames(cx: &mut GpuCx, light_count: usize, face_count: usize) -> Target {
    let sample_count = cx.dim(ports::POSITION.name, 0);
    let all = light_count * face_count;
    let frames = cx.scratch("frames", FACE_WORDS * all);
    let reduction = cx.scratch("fit", FIT_WORDS * (all + 1));
    cx.zero(reduction);
    let bind = vec![
        Uniform(light_fit::uniform(sample_count, light_count, face_count)),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(input::LIGHT_SAMPLES.name)),
        ReadWrite(reduction),
        ReadWrite(frames),
        ReadWrite(Counters),
        Read(Port(ports::LIGHT_FRAME.name)),
    ];
    for (label, entry, count) in [
        ("multi_shadow_map axes", "multi_shadow_map_axes", all),
        ("multi_shadow_map windows", "multi_shadow_map_windows", light_count * light_fit::invocations(sample_count)),
        ("multi_shadow_map fit", "multi_shadow_map_fit", all),
    ] {
        cx.dispatch(label, FRAMES, entry, bind.clone(), count, GROUP);
    }
    frames
}

fn draw(cx: &mut GpuCx, frames: Target, maps: Target, side: u32, face: u32, layer: u32) {
    cx.push(Command::Draw(Draw {
        label: "multi_shadow_map draw",
        shader: Shader { pieces: DRAW, constants: Vec::new() },
        vertex: "multi_shadow_map_draw",
        fragment: None,
        bind: vec![
            Uniform(vec![face]),
            Read(Port(input::TRIANGLES.name)),
            Read(Port(ports::CASTER_STATE.name)),
            Read(frames),
        ],
        vertices: 3 * cx.dim(input::TRIANGLES.name, 0) as u32,
        instances: 1,
        size: [side, side],
        color: Vec::new(),
        depth: Some(DepthTarget { target: maps, layer, clear: Some(shadow_raster::CLEAR), write: true }),
        cull: Cull::None,
        conservative: false,
    }));
}

fn compare(cx: &mut GpuCx, frames: Target, maps: Target, side: u32, [first, end]: [usize; 2]) {
    let lookup = super::lookup(cx.params());
    let rows = cx.dim(ports::POSITION.name, 0);
    let bind = vec![
        Uniform(vec![
            rows as u32,
            cx.dim(ports::LIGHT_FRAME.name, 0) as u32,
            side,
            cx.dim(ports::MASK.name, 1) as u32,
            lookup.bias_constant.to_bits(),
            lookup.bias_slope.to_bits(),
            lookup.normal_offset.to_bits(),
            first as u32,
            end as u32,
        ]),
        Texture(maps),
        Read(frames),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::NORMAL.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        ReadWrite(Port(ports::MASK.name)),
    ];
    cx.dispatch("multi_shadow_map compare", COMPARE, "multi_shadow_map", bind, rows, GROUP);
}
