//! Two draws for each face: the nearest surface into scratch, then what lies behind it.

use crate::ports;
use crate::shared::shadow_raster::CLEAR;
use crate::shared::{light_frame, shadow_map};
use shadowgraph_core::input;
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, Texture, Uniform};
use shadowgraph_core::record::{Command, Cull, DepthTarget, Draw, GpuCx, Shader, Target, Target::Port};
use shadowgraph_core::shared::PRELUDE;

/// The first draw.
pub const FIRST: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    shadow_map::WGSL,
    include_str!("../../shared/shadow_vertex.wgsl"),
    include_str!("first.wgsl"),
];

/// The second draw.
pub const SECOND: &[&str] = &[
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
    // One layer serves face after face.
    let first = cx.scratch_texture("first surface", Storage::DepthTexture, vec![1, side as usize, side as usize]);
    for layer in 0..cx.dim(ports::DEPTH.name, 0) as u32 {
        let bind = vec![
            Uniform(vec![layer]),
            Read(Port(input::TRIANGLES.name)),
            Read(Port(ports::CASTER_STATE.name)),
            Read(Port(ports::LIGHT_FRAME.name)),
        ];
        let draw = |pieces, vertex, fragment, bind, target: Target, layer| {
            Command::Draw(Draw {
                label: "light_depth/second_surface",
                shader: Shader { pieces, constants: Vec::new() },
                vertex,
                fragment,
                bind,
                vertices,
                instances: 1,
                size: [side, side],
                color: Vec::new(),
                depth: Some(DepthTarget { target, layer, clear: Some(CLEAR), write: true }),
                cull: Cull::None,
                conservative: false,
            })
        };
        cx.push(draw(FIRST, "second_surface_first", None, bind.clone(), first, 0));
        let bind = [bind, vec![Texture(first)]].concat();
        let behind = Some("second_surface_behind");
        cx.push(draw(SECOND, "second_surface", behind, bind, Port(ports::DEPTH.name), layer));
    }
    Ok(())
}
