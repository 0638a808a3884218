//! One dispatch; each invocation looks at every light sample.

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, LOOP_STEPS, PRELUDE};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.dim(ports::POSITION.name, 0);
    let lights = cx.dim(input::LIGHT_SAMPLES.name, 0);
    if lights > LOOP_STEPS {
        return Err(Problem::new(Kind::Unsupported, "too many light samples for one kernel invocation")
            .port(input::LIGHT_SAMPLES.name)
            .expected(format!("at most {LOOP_STEPS}"))
            .found(lights.to_string())
            .remedy("run this node on the CPU, or use sample_filter all"));
    }
    let bind = vec![
        Uniform(vec![count as u32, lights as u32, 0, 0]),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::NORMAL.name)),
        Read(Port(ports::TRIANGLE.name)),
        Read(Port(input::LIGHT_SAMPLES.name)),
        ReadWrite(Port(ports::SAMPLE_STATE.name)),
    ];
    let pieces = &[PRELUDE, include_str!("kernel.wgsl")];
    cx.dispatch("sample_filter/light_facing", pieces, "light_facing", bind, count, GROUP);
    Ok(())
}
