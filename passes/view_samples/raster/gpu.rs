//! The farthest depth, one draw into a texture of triangle numbers, and the surface points from those.

use crate::ports;
use crate::shared::camera;
use shadowgraph_core::input;
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Texture, Uniform};
use shadowgraph_core::record::{ColorTarget, Command, Cull, DepthTarget, Draw, GpuCx, Shader, Target::Port};
use shadowgraph_core::shared::{GROUP, NO_TRIANGLE, PRELUDE};

const FAR: &[&str] = &[PRELUDE, camera::WGSL, include_str!("far.wgsl")];
const DRAW: &[&str] = &[PRELUDE, camera::WGSL, include_str!("draw.wgsl")];
const KERNEL: &[&str] = &[PRELUDE, camera::WGSL, include_str!("kernel.wgsl")];

/// Triangles that one invocation looks at for the farthest depth.
const TRIANGLES_PER_INVOCATION: usize = 64;

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let [width, height] = cx.image();
    let side = cx.limits().texture_side;
    if width.max(height) > side as usize {
        return Err(Problem::new(Kind::Unsupported, "the picture is larger than the device's textures")
            .expected(format!("at most {side} x {side}"))
            .found(format!("{width} x {height}"))
            .remedy("run this node on the CPU"));
    }
    let (count, triangle_count) = (width * height, cx.dim(input::TRIANGLES.name, 0));
    let ids = cx.scratch_texture("triangle of each pixel", Storage::R32Uint, vec![height, width]);
    let depth = cx.scratch_texture("depth", Storage::DepthTexture, vec![1, height, width]);
    let farthest = cx.scratch("farthest depth", 1);
    let triangles = Read(Port(input::TRIANGLES.name));
    let camera = Read(Port(input::CAMERA.name));

    let invocations = triangle_count.div_ceil(TRIANGLES_PER_INVOCATION);
    let size = Uniform(vec![triangle_count as u32, invocations as u32, 0, 0]);
    cx.zero(farthest);
    let bind = vec![size, triangles.clone(), camera.clone(), ReadWrite(farthest)];
    cx.dispatch("view_samples/raster far", FAR, "raster_far", bind, invocations, GROUP);

    cx.push(Command::Draw(Draw {
        label: "view_samples/raster draw",
        shader: Shader { pieces: DRAW, constants: Vec::new() },
        vertex: "raster_vertex",
        fragment: Some("raster_fragment"),
        bind: vec![triangles.clone(), camera.clone(), Read(farthest)],
        vertices: 3 * triangle_count as u32,
        instances: 1,
        size: [width as u32, height as u32],
        color: vec![ColorTarget { target: ids, clear: Some([NO_TRIANGLE.into(), 0.0, 0.0, 0.0]) }],
        depth: Some(DepthTarget { target: depth, layer: 0, clear: Some(1.0), write: true }),
        cull: Cull::None,
        conservative: false,
    }));

    let bind = vec![
        Uniform(vec![count as u32, width as u32, 0, 0]),
        Texture(ids),
        triangles,
        camera,
        ReadWrite(Port(ports::POSITION.name)),
        ReadWrite(Port(ports::NORMAL.name)),
        ReadWrite(Port(ports::TRIANGLE.name)),
        ReadWrite(Port(ports::PIXEL.name)),
    ];
    cx.dispatch("view_samples/raster resolve", KERNEL, "raster_resolve", bind, count, GROUP);
    Ok(())
}
