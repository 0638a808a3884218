//! One draw of a triangle over the whole texture.

use super::IMAGE_TEXTURE;
use crate::ports;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, Uniform};
use shadowgraph_core::record::{ColorTarget, Command, Cull, Draw, GpuCx, Shader, Target::Port};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let [height, width] = [0, 1].map(|axis| cx.dim(ports::IMAGE.name, axis));
    let side = cx.limits().texture_side;
    if width.max(height) > side as usize {
        return Err(Problem::new(Kind::Unsupported, "the picture is larger than the device's textures")
            .port(IMAGE_TEXTURE)
            .expected(format!("at most {side} x {side}"))
            .found(format!("{width} x {height}")));
    }
    cx.push(Command::Draw(Draw {
        label: "present/to_rgba32float",
        shader: Shader { pieces: &[include_str!("kernel.wgsl")], constants: Vec::new() },
        vertex: "to_rgba32float_vertex",
        fragment: Some("to_rgba32float"),
        bind: vec![Uniform(vec![width as u32, 0, 0, 0]), Read(Port(ports::IMAGE.name))],
        vertices: 3,
        instances: 1,
        size: [width as u32, height as u32],
        color: vec![ColorTarget { target: Port(IMAGE_TEXTURE), clear: Some([0.0; 4]) }],
        depth: None,
        cull: Cull::None,
        conservative: false,
    }));
    Ok(())
}
