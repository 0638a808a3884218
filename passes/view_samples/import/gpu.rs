//! Copies, and one dispatch that counts bad rows.

use super::row_count;
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{Command, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = row_count(|name| cx.is_connected(name).then(|| cx.shape(name)))?;
    let triangle_count = cx.dim(input::TRIANGLES.name, 0);
    let has_pixel = cx.is_connected(input::IMPORTED_PIXEL.name);
    for (from, to) in [
        (input::IMPORTED_POSITION.name, ports::POSITION.name),
        (input::IMPORTED_NORMAL.name, ports::NORMAL.name),
        (input::IMPORTED_TRIANGLE.name, ports::TRIANGLE.name),
        (input::IMPORTED_PIXEL.name, ports::PIXEL.name),
    ] {
        if cx.is_connected(from) {
            cx.push(Command::Copy { from: Target::Port(from), to: Target::Port(to), words: cx.words(from) });
        }
    }
    let bind = vec![
        Uniform(vec![count as u32, triangle_count as u32, u32::from(has_pixel), 0]),
        Read(Target::Port(ports::POSITION.name)),
        Read(Target::Port(ports::NORMAL.name)),
        Read(Target::Port(ports::TRIANGLE.name)),
        ReadWrite(Target::Port(ports::PIXEL.name)),
        ReadWrite(Target::Counters),
    ];
    cx.dispatch("view_samples/import", &[PRELUDE, include_str!("kernel.wgsl")], "import_check", bind, count, GROUP);
    Ok(())
}
