//! One depth-only draw for each face.

use crate::ports;
use crate::shared::{light_frame, shadow_map};
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, Uniform};
use shadowgraph_core::record::{Command, Cull, DepthTarget, Draw, GpuCx, Shader, Target::Port};
use shadowgraph_core::shared::PRELUDE;

/// Everything the draw is made of.
pub const PIECES: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    shadow_map::WGSL,
    include_str!("../../shared/shadow_vertex.wgsl"),
    include_str!("kernel.wgsl"),
];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let side = shadow_map::side_on_device(cx, super::super::SIZE.name)?;
    let vertices = 3 * cx.dim(input::TRIANGLES.name, 0) as u32;
    for layer in 0..cx.dim(ports::DEPTH.name, 0) as u32 {
        cx.push(Command::Draw(Draw {
            label: "light_depth/first_surface",
            shader: Shader { pieces: PIECES, constants: Vec::new() },
            vertex: "first_surface",
            fragment: None,
            bind: vec![
                Uniform(vec![layer]),
                Read(Port(input::TRIANGLES.name)),
                Read(Port(ports::CASTER_STATE.name)),
                Read(Port(ports::LIGHT_FRAME.name)),
            ],
            vertices,
            instances: 1,
            size: [side, side],
            color: Vec::new(),
            depth: Some(DepthTarget {
                target: Port(ports::DEPTH.name),
                layer,
                clear: Some(crate::shared::shadow_raster::CLEAR),
                write: true,
            }),
            cull: Cull::None,
            conservative: false,
        }));
    }
    Ok(())
}
