//! Normals of each view-sample, the sums, then colours.

use super::light_shape;
use crate::ports;
use crate::shade::gpu::{COLOR, NUMBERS, Picture, REFLECTION, SURFACE, surface_bind};
use crate::shade::reflection::Reflection;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite};
use shadowgraph_core::record::{Bind, GpuCx, Target::Port};
use shadowgraph_core::shared::{LOOP_STEPS, PRELUDE};

const NORMALS: &[&str] = &[PRELUDE, NUMBERS, shading::WGSL, SURFACE, include_str!("normals.wgsl")];
const SUMS: &[&str] = &[PRELUDE, NUMBERS, shading::WGSL, REFLECTION, include_str!("kernel.wgsl")];
const COLORS: &[&str] = &[PRELUDE, NUMBERS, COLOR, include_str!("color.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let light = light_shape(|name| cx.is_connected(name).then(|| cx.shape(name)))?;
    let steps = light[0] + light[1];
    if steps > LOOP_STEPS {
        return Err(Problem::new(Kind::Unsupported, "too many light samples for one invocation")
            .port(input::LIGHT_SAMPLES.name)
            .expected(format!("at most {LOOP_STEPS} loop steps"))
            .found(steps.to_string())
            .remedy("set `on: Cpu`, or take fewer light samples"));
    }
    let rows = cx.dim(ports::POSITION.name, 0);
    let Reflection { specular, shininess } = Reflection::new(cx.params());
    let picture = Picture::start(cx, [specular, shininess], light);
    let normals = cx.scratch("normals of each view-sample", 6 * rows);
    let bind = [&surface_bind() as &[Bind], &[ReadWrite(normals)]].concat();
    picture.each(cx, "shade/full_sum: normals", NORMALS, "full_sum_normals", &bind);
    let lighting = cx.scratch("light terms", 6 * rows);
    let bind = [
        Read(normals),
        Read(Port(ports::POSITION.name)),
        Read(picture.place),
        Read(Port(ports::MASK.name)),
        Read(Port(input::LIGHT_SAMPLES.name)),
        Read(Port(input::LIGHT_WEIGHTS.name)),
        Read(Port(input::CAMERA.name)),
        ReadWrite(lighting),
    ];
    picture.each(cx, "shade/full_sum: sums", SUMS, "full_sum", &bind);
    picture.color(cx, "shade/full_sum: colours", COLORS, lighting, &[]);
    Ok(())
}
