//! The box, then entries of `faces`, then corners.

use crate::bent_light::around;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, LOOP_STEPS, PRELUDE};

const BOX: &[&str] = &[PRELUDE, include_str!("light_box.wgsl")];
const PIECES: &[&str] = &[PRELUDE, shading::WGSL, around::WGSL, include_str!("kernel.wgsl")];
const STEPS: around::Steps =
    [("bent_light/bounding_box: entries", "bounding_box_step"), ("bent_light/bounding_box: corners", "bounding_box")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let samples = cx.dim(input::LIGHT_SAMPLES.name, 0);
    if samples > LOOP_STEPS * GROUP {
        return Err(Problem::new(Kind::Unsupported, "too many light samples for one workgroup")
            .port(input::LIGHT_SAMPLES.name)
            .expected(format!("at most {}", LOOP_STEPS * GROUP))
            .found(samples.to_string())
            .remedy("set `on: Cpu`, or take fewer light samples"));
    }
    let light_box = cx.scratch("box around the light samples", 7);
    let bind = vec![Uniform(vec![samples as u32]), Read(Port(input::LIGHT_SAMPLES.name)), ReadWrite(light_box)];
    cx.dispatch("bent_light/bounding_box: box", BOX, "find_light_box", bind, 1, 1);
    around::record(cx, PIECES, STEPS, light_box);
    Ok(())
}
