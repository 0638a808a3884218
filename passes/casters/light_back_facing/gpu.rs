//! One dispatch.

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::record::Target::{Counters, Port};
use shadowgraph_core::scene::flag;
use shadowgraph_core::shared::{GROUP, LOOP_STEPS, PRELUDE};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (count, samples) = (cx.dim(input::TRIANGLES.name, 0), cx.dim(input::LIGHT_SAMPLES.name, 0));
    if samples > LOOP_STEPS {
        return Err(Problem::new(Kind::Unsupported, "too many light samples for one invocation")
            .port(input::LIGHT_SAMPLES.name)
            .expected(format!("at most {LOOP_STEPS}"))
            .found(samples.to_string())
            .remedy("use casters/all, or set `on: Cpu`"));
    }
    let bind = vec![
        Uniform(vec![count as u32, samples as u32, flag::CLOSED, 0]),
        Read(Port(input::TRIANGLES.name)),
        Read(Port(input::TRIANGLE_FLAGS.name)),
        Read(Port(input::LIGHT_SAMPLES.name)),
        ReadWrite(Port(ports::CASTER_STATE.name)),
        ReadWrite(Counters),
    ];
    let pieces = &[PRELUDE, include_str!("kernel.wgsl")];
    cx.dispatch("casters/light_back_facing", pieces, "light_back_facing", bind, count, GROUP);
    Ok(())
}
