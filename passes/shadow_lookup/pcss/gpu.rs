//! One dispatch; 512 loop steps at most, and one for each word of the mask.

use super::taps::{MOST_TAPS, spiral};
use crate::ports;
use crate::shared::{light_frame, shadow_lookup, shadow_map};
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Texture, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// Everything the kernel is made of.
pub const PIECES: &[&str] =
    &[PRELUDE, light_frame::WGSL, shadow_map::WGSL, shadow_lookup::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let params = cx.params();
    let lookup = super::super::settings(params, 1);
    let rows = cx.dim(ports::POSITION.name, 0);
    let counts = [super::SEARCH_TAPS, super::FILTER_TAPS].map(|spec| params.u32(spec.name));
    let mut words = vec![
        rows as u32,
        cx.dim(ports::DEPTH.name, 0) as u32,
        cx.dim(ports::DEPTH.name, 1) as u32,
        cx.dim(input::LIGHT_SAMPLES.name, 0) as u32,
        lookup.bias_constant.to_bits(),
        lookup.bias_slope.to_bits(),
        lookup.normal_offset.to_bits(),
        params.f32(super::NEAREST_BLOCKER.name).to_bits(),
        params.f32(super::LARGEST_WIDTH.name).to_bits(),
        counts[0],
        counts[1],
        0,
    ];
    for count in counts {
        let mut taps = spiral(count as usize);
        taps.resize(MOST_TAPS, [0.0; 2]);
        words.extend(taps.as_flattened().iter().map(|x| x.to_bits()));
    }
    let bind = vec![
        Uniform(words),
        Texture(Port(ports::DEPTH.name)),
        Read(Port(ports::LIGHT_FRAME.name)),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::NORMAL.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(input::LIGHT.name)),
        ReadWrite(Port(ports::MASK.name)),
        ReadWrite(Port(ports::VISIBLE.name)),
    ];
    cx.dispatch("shadow_lookup/pcss", PIECES, "pcss", bind, rows, GROUP);
    Ok(())
}
