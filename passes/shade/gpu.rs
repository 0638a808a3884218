//! The recipe of every way to shade, in dispatches of at most eight storage buffers: where colours go, light terms, colours.

use super::params::Settings;
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{Bind, GpuCx, Target, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// WGSL of every dispatch: what the numbers mean.
pub const NUMBERS: &str = include_str!("numbers.wgsl");
/// WGSL: what is seen at a view-sample.
pub const SURFACE: &str = include_str!("surface.wgsl");
/// WGSL: light terms from the light's centre.
pub const CENTRE: &str = include_str!("centre.wgsl");
/// WGSL: light terms to colours.
pub const COLOR: &str = include_str!("color.wgsl");
/// WGSL: the visible share of the light.
pub const VISIBLE: &str = include_str!("visible.wgsl");
/// WGSL: cosine and highlight.
pub const REFLECTION: &str = include_str!("reflection.wgsl");

const PLACE: &[&str] = &[PRELUDE, NUMBERS, include_str!("place.wgsl")];

/// What the dispatches of one picture share.
pub struct Picture {
    numbers: Vec<u32>,
    /// Where the colour of each view-sample goes: a pixel, or all bits set.
    pub place: Target,
    rows: usize,
}

impl Picture {
    /// Records the background and the places; `own` are the pass's two numbers, `light` light samples and mask words.
    pub fn start(cx: &mut GpuCx, own: [f32; 2], light: [usize; 2]) -> Self {
        let settings = Settings::new(cx.params());
        let [width, height] = cx.image();
        let rows = cx.dim(ports::POSITION.name, 0);
        let [red, green, blue] = settings.background.to_array().map(f32::to_bits);
        let numbers = vec![
            rows as u32,
            cx.dim(input::TRIANGLES.name, 0) as u32,
            (width * height) as u32,
            u32::from(settings.falloff_distance.is_some()),
            red,
            green,
            blue,
            settings.ambient.to_bits(),
            settings.falloff_distance.unwrap_or(1.0).to_bits(),
            own[0].to_bits(),
            own[1].to_bits(),
            if visible_port(cx) == ports::VISIBLE_COLOR.name { 3 } else { 1 },
            light[0] as u32,
            light[1] as u32,
        ];
        let place = cx.scratch("place of each view-sample", rows);
        let picture = Self { numbers, place, rows };
        let bind = picture.bind(&[
            Read(Port(ports::TRIANGLE.name)),
            Read(Port(ports::PIXEL.name)),
            Read(Port(ports::SAMPLE_STATE.name)),
            ReadWrite(place),
            ReadWrite(Port(ports::IMAGE.name)),
            ReadWrite(Target::Counters),
        ]);
        cx.dispatch("shade: places", PLACE, "shade_place", bind, rows.max(width * height), GROUP);
        picture
    }

    /// Numbers, then `rest`.
    fn bind(&self, rest: &[Bind]) -> Vec<Bind> {
        std::iter::once(Uniform(self.numbers.clone())).chain(rest.iter().cloned()).collect()
    }

    /// Records one invocation a view-sample.
    pub fn each(
        &self,
        cx: &mut GpuCx,
        label: &'static str,
        pieces: &'static [&'static str],
        entry: &'static str,
        rest: &[Bind],
    ) {
        cx.dispatch(label, pieces, entry, self.bind(rest), self.rows, GROUP);
    }

    /// Records colours from `lighting`; `last` is what the pass binds alone.
    pub fn color(
        &self,
        cx: &mut GpuCx,
        label: &'static str,
        pieces: &'static [&'static str],
        lighting: Target,
        last: &[Bind],
    ) {
        let bind = [
            Read(lighting),
            Read(self.place),
            Read(Port(ports::TRIANGLE.name)),
            Read(Port(input::TRIANGLE_ALBEDO.name)),
            Read(Port(input::LIGHT.name)),
            ReadWrite(Port(ports::IMAGE.name)),
        ];
        self.each(cx, label, pieces, "shade_color", &[&bind, last].concat());
    }
}

/// What surface.wgsl binds.
pub fn surface_bind() -> [Bind; 5] {
    [ports::POSITION, ports::NORMAL, ports::TRIANGLE, input::TRIANGLES, input::TRIANGLE_NORMALS]
        .map(|port| Read(Port(port.name)))
}

/// The port that says how much of the light is visible.
fn visible_port(cx: &GpuCx) -> &'static str {
    let color = ports::VISIBLE_COLOR.name;
    if cx.is_connected(color) && cx.dim(color, 0) > 0 { color } else { ports::VISIBLE.name }
}

/// The factored form: light terms from the light's centre by `entry` of `terms`, which reads `port` alone; then colours by `color`.
pub fn record_factored(
    cx: &mut GpuCx,
    label: &'static str,
    [terms, color]: [&'static [&'static str]; 2],
    entry: &'static str,
    own: [f32; 2],
    port: &'static str,
) {
    let picture = Picture::start(cx, own, [0, 0]);
    let lighting = cx.scratch("light terms", 3 * picture.rows);
    let last = [Read(Port(input::LIGHT.name)), Read(Port(port)), ReadWrite(lighting)];
    picture.each(cx, label, terms, entry, &[&surface_bind() as &[Bind], &last].concat());
    let visible = Read(Port(visible_port(cx)));
    picture.color(cx, label, color, lighting, &[visible]);
}
