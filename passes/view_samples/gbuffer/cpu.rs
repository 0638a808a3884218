//! Three of four words, texel by texel.

use super::texture_size;
use crate::ports;
use crate::view_samples::surface::Seen;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::NO_TRIANGLE;

/// View-samples of all texels.
pub fn gather(positions: &[[f32; 4]], normals: &[[f32; 4]], triangles: &[u32]) -> Seen {
    let three = |texels: &[[f32; 4]]| -> Vec<[f32; 3]> {
        let rows = texels.iter().zip(triangles);
        rows.map(|([x, y, z, _], triangle)| if *triangle == NO_TRIANGLE { [0.0; 3] } else { [*x, *y, *z] }).collect()
    };
    Seen { positions: three(positions), normals: three(normals), triangles: triangles.to_vec() }
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    texture_size(|name| cx.optional(name).map(Array::shape))?;
    let texels = |name: &str| bytemuck::cast_slice(cx.input(name).as_f32());
    let (positions, normals) = (texels(ports::GBUFFER_POSITION.name), texels(ports::GBUFFER_NORMAL.name));
    gather(positions, normals, cx.input(ports::GBUFFER_TRIANGLE.name).as_u32()).put(cx);
    Ok(())
}
