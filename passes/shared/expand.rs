//! Draws of grown casters, and the pairs they make.

use crate::shared::light_frame;
use crate::shared::share::check_hard;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, Command, Cull, Draw, GpuCx, Shader, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const EXPAND: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("predicate.wgsl"),
    include_str!("pyramid.wgsl"),
    include_str!("footprint.wgsl"),
    FAN_WGSL,
    include_str!("expand.wgsl"),
];
const PAIR: &[&str] = &[FAN_WGSL, include_str!("pair_draw.wgsl")];

/// The vertex stage in WGSL.
pub const FAN_WGSL: &str = include_str!("fan.wgsl");
/// Vertices of a fan.
const FAN_VERTICES: u32 = 12;
/// Words of a fan in memory; `FAN` in the WGSL.
const FAN_WORDS: usize = 22;

/// What a draw over the fans of a face runs.
#[derive(Clone, Copy, Debug)]
pub struct FanDraw {
    /// Label of the draw.
    pub label: &'static str,
    /// Pieces of both stages; the vertex entry is `fan`.
    pub pieces: &'static [&'static str],
    /// Fragment entry.
    pub fragment: &'static str,
    /// How far to grow the outlines beyond what rounding asks for, texels.
    pub grow: f32,
    /// Whether the device is to rasterise conservatively.
    pub conservative: bool,
    /// A word for each face, 1 where view-samples lie beyond its window, see `record_pack`. None: they may.
    pub beyond: Option<Target>,
}

/// Records a draw for each face; `bind` makes its bindings from the fans and the number of the face.
///
/// # Errors
/// What [`check_hard`] refuses; more texels than a target of the device has.
pub fn record_fans(cx: &mut GpuCx, draw: FanDraw, bind: impl Fn(Target, u32) -> Vec<Bind>) -> Result<(), Problem> {
    check_hard(cx)?;
    let triangle_count = cx.dim("triangles", 0);
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)].map(|count| count as u32);
    let most = cx.limits().texture_side;
    if side > most {
        return Err(Problem::new(Kind::Unsupported, "the light's image is larger than this device can draw")
            .port("list_length")
            .expected(format!("at most {most} texels a side"))
            .found(side.to_string())
            .remedy("use fewer texels, or conservative_raster: binning"));
    }
    let fans = cx.scratch("fans", FAN_WORDS * triangle_count);
    let beyond = draw.beyond.unwrap_or_else(|| cx.scratch("fans_beyond", face_count as usize));
    for face in 0..face_count {
        let numbers = Bind::Uniform(vec![
            triangle_count as u32,
            face,
            side,
            draw.grow.to_bits(),
            draw.beyond.is_none().into(),
            0,
        ]);
        let expand = vec![
            numbers,
            Bind::Read(Target::Port("triangles")),
            Bind::Read(Target::Port("caster_state")),
            Bind::Read(Target::Port("light_samples")),
            Bind::Read(Target::Port("light_frame")),
            Bind::ReadWrite(fans),
            Bind::Read(beyond),
        ];
        cx.dispatch("expand", EXPAND, "expand", expand, triangle_count, GROUP);
        cx.push(Command::Draw(Draw {
            label: draw.label,
            shader: Shader { pieces: draw.pieces, constants: Vec::new() },
            vertex: "fan",
            fragment: Some(draw.fragment),
            bind: bind(fans, face),
            vertices: FAN_VERTICES,
            instances: triangle_count as u32,
            size: [side, side],
            color: Vec::new(),
            depth: None,
            cull: Cull::None,
            conservative: draw.conservative,
        }));
    }
    Ok(())
}

/// Records stage `conservative_raster` by draws: every fragment appends its pair. Its counter 0 is `pairs`.
///
/// # Errors
/// As [`record_fans`].
pub fn record_pairs(cx: &mut GpuCx, label: &'static str, grow: f32, conservative: bool) -> Result<(), Problem> {
    let side = cx.dim("list_length", 1) as u32;
    cx.zero(Target::Port("caster_length"));
    record_fans(
        cx,
        FanDraw { label, pieces: PAIR, fragment: "pair", grow, conservative, beyond: None },
        |fans, face| {
            vec![
                Bind::Uniform(vec![face, side]),
                Bind::Read(fans),
                Bind::Read(Target::Port("list_length")),
                Bind::Read(Target::Port("list_far")),
                Bind::ReadWrite(Target::Port("pair_cell")),
                Bind::ReadWrite(Target::Port("pair_slot")),
                Bind::ReadWrite(Target::Port("pair_caster")),
                Bind::ReadWrite(Target::Port("caster_length")),
                Bind::ReadWrite(Target::Counters),
            ]
        },
    )
}
