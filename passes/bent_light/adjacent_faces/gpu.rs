//! Clear, one dispatch over the entries of `faces`, one over the corners.

use crate::ports;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// Everything both kernels are made of.
pub const PIECES: &[&str] = &[PRELUDE, shading::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let corners = cx.words(ports::CORNER_LIGHT.name);
    let vertices = cx.words(input::FACE_OFFSET.name).saturating_sub(1);
    let entries = cx.words(input::FACES.name);
    let smallest = cx.scratch("smallest cosine of each vertex", vertices);
    cx.zero(smallest);
    let bind = vec![
        Uniform(vec![corners as u32, vertices as u32, entries as u32]),
        Read(Port(input::TRIANGLES.name)),
        Read(Port(input::CORNER_VERTEX.name)),
        Read(Port(input::LIGHT.name)),
        ReadWrite(smallest),
        Read(Port(input::FACE_OFFSET.name)),
        Read(Port(input::FACES.name)),
        ReadWrite(Port(ports::CORNER_LIGHT.name)),
    ];
    cx.dispatch("bent_light/adjacent_faces: entries", PIECES, "adjacent_faces_step", bind.clone(), entries, GROUP);
    cx.dispatch("bent_light/adjacent_faces: corners", PIECES, "adjacent_faces", bind, corners, GROUP);
    Ok(())
}
