//! The recipe of every way to shade: the background, then one invocation for each view-sample.

use super::params::Settings;
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target, Target::Port};
use shadowgraph_core::shared::GROUP;

/// Records both dispatches; `last` is what the pass alone reads, from binding 13 on.
pub fn record(
    cx: &mut GpuCx,
    label: &'static str,
    pieces: &'static [&'static str],
    entry: &'static str,
    [first, second]: [f32; 2],
    last: &[&'static str],
) {
    let settings = Settings::new(cx.params());
    let [width, height] = cx.image();
    let rows = cx.dim(ports::POSITION.name, 0);
    let [red, green, blue] = settings.background.to_array().map(f32::to_bits);
    let mut bind = vec![
        Uniform(vec![
            rows as u32,
            cx.dim(input::TRIANGLES.name, 0) as u32,
            (width * height) as u32,
            u32::from(settings.falloff_distance.is_some()),
            red,
            green,
            blue,
            settings.ambient.to_bits(),
            settings.falloff_distance.unwrap_or(1.0).to_bits(),
            first.to_bits(),
            second.to_bits(),
        ]),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::NORMAL.name)),
        Read(Port(ports::TRIANGLE.name)),
        Read(Port(ports::PIXEL.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(ports::VISIBLE.name)),
        Read(Port(input::TRIANGLES.name)),
        Read(Port(input::TRIANGLE_NORMALS.name)),
        Read(Port(input::TRIANGLE_ALBEDO.name)),
        Read(Port(input::LIGHT.name)),
        ReadWrite(Port(ports::IMAGE.name)),
        ReadWrite(Target::Counters),
    ];
    bind.extend(last.iter().map(|port| Read(Port(port))));
    cx.dispatch(label, pieces, "shade_background", bind.clone(), width * height, GROUP);
    cx.dispatch(label, pieces, entry, bind, rows, GROUP);
}
