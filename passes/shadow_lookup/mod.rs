//! Stage `shadow_lookup`: Compares each view-sample with the shadow map (Williams 1978; Reeves 1987).

pub mod compare;
pub mod pcf;
pub mod pcss;

use crate::ports;
use crate::shared::light_frame::faces;
use crate::shared::shadow_lookup::{BIAS_CONSTANT, BIAS_SLOPE, Lookup, Map, NORMAL_OFFSET, visible};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Texture, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{BACKGROUND, GROUP, KEPT};
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "shadow_lookup",
    doc: "Compares each view-sample with the shadow map (Williams 1978; Reeves 1987).",
    ports: &[
        ports::DEPTH.read(),
        ports::LIGHT_FRAME.read(),
        ports::POSITION.read(),
        ports::NORMAL.read(),
        ports::SAMPLE_STATE.read(),
        input::LIGHT_SAMPLES.read(),
        input::LIGHT.read(),
        ports::MASK,
        ports::VISIBLE,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&compare::PASS, &pcf::PASS, &pcss::PASS];

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let rows = cx.dim(ports::POSITION.name, 0);
    vec![(ports::MASK.name, vec![rows, 1]), (ports::VISIBLE.name, vec![rows])]
}

fn settings(params: &Params, kernel: u32) -> Lookup {
    Lookup {
        bias_constant: params.f32(BIAS_CONSTANT.name),
        bias_slope: params.f32(BIAS_SLOPE.name),
        normal_offset: params.f32(NORMAL_OFFSET.name),
        kernel,
    }
}

/// A shadow map has one centre of projection.
fn one_light_sample(count: usize) -> Result<(), Problem> {
    if count == 1 {
        return Ok(());
    }
    Err(Problem::new(Kind::Unsupported, "a shadow map answers for one light sample")
        .port(input::LIGHT_SAMPLES.name)
        .expected("1 light sample")
        .found(count.to_string())
        .remedy("use the graph multi_shadow_map, or pcss"))
}

/// Share and mask of every view-sample: the CPU function of every pass here but for its kernel.
fn look_up(cx: &mut CpuCx, kernel: u32) -> Result<(), Problem> {
    one_light_sample(cx.input(input::LIGHT_SAMPLES.name).dim(0))?;
    let lookup = settings(cx.params(), kernel);
    let depth = cx.input(ports::DEPTH.name);
    let faces = faces(cx.input(ports::LIGHT_FRAME.name).as_f32());
    let map = Map { faces: &faces, depth: depth.as_f32(), side: depth.dim(1) };
    let (position, normal) = (cx.input(ports::POSITION.name).as_vec3(), cx.input(ports::NORMAL.name).as_vec3());
    let (shares, masks): (Vec<f32>, Vec<u32>) = cx
        .input(ports::SAMPLE_STATE.name)
        .as_u32()
        .par_iter()
        .enumerate()
        .map(|(row, state)| match *state {
            BACKGROUND => (1.0, 0),
            KEPT => {
                let share = visible(map, lookup, Vec3::from(position[row]), Vec3::from(normal[row]));
                (share, u32::from(share < 0.5))
            }
            _ => (0.0, u32::MAX),
        })
        .unzip();
    cx.put(ports::MASK.name, Array::u32([masks.len(), 1], masks));
    cx.put(ports::VISIBLE.name, Array::f32([shares.len()], shares));
    Ok(())
}

/// The recipe of every pass here but for its kernel.
fn dispatch(
    cx: &mut GpuCx,
    label: &'static str,
    pieces: &'static [&'static str],
    entry: &'static str,
    kernel: u32,
) -> Result<(), Problem> {
    one_light_sample(cx.dim(input::LIGHT_SAMPLES.name, 0))?;
    let lookup = settings(cx.params(), kernel);
    let rows = cx.dim(ports::POSITION.name, 0);
    let [faces, side] = [0, 1].map(|axis| cx.dim(ports::DEPTH.name, axis) as u32);
    let bind = vec![
        Uniform(vec![
            rows as u32,
            faces,
            side,
            kernel,
            lookup.bias_constant.to_bits(),
            lookup.bias_slope.to_bits(),
            lookup.normal_offset.to_bits(),
        ]),
        Texture(Port(ports::DEPTH.name)),
        Read(Port(ports::LIGHT_FRAME.name)),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::NORMAL.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        ReadWrite(Port(ports::MASK.name)),
        ReadWrite(Port(ports::VISIBLE.name)),
    ];
    cx.dispatch(label, pieces, entry, bind, rows, GROUP);
    Ok(())
}
