//! `multi_shadow_map`: a shadow map for each light sample (Heckbert, Herf 1997; Sintorn, Eisemann, Assarsson 2008, section 2,
//! the sum of point lights), as masks: one comparison decides one bit.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts), `light_samples [L 3]` world, any L, `light_frame [F 20]`,
//! `position [P 3]` world, `normal [P 3]` world, `sample_state [P]`. Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set
//! for a view-sample facing away, unused ones too, none for background.
//!
//! Every light sample looks along the axes of `light_frame` from where it is, through windows fitted to the view-samples as it
//! sees them: with one light sample these are the faces of `light_frame: fitted`, or `six_faces`, and the answer is that of the
//! single shadow map, bit for bit. Maps take `4 F size^2` bytes a light sample; they are drawn and looked up in ranges of as many
//! light samples as `memory` holds, into one depth target. More than 2 GiB at a time on the CPU is an error that names what fits.
//!
//! Where a frame is run in ranges of view-samples, windows are fitted to each range's view-samples: its texels are finer than
//! those of the whole frame, and bits at shadow borders may differ from those of one run.
//!
//! Errors are those of a shadow map: steps of a texel's width at shadow borders, casters thinner than a texel, and biases
//! ([`crate::shared::shadow_lookup`]). What falls outside a map is lit. `behind` counts pairs that a single face cannot place.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use crate::shared::shadow_lookup::{BIAS_CONSTANT, BIAS_SLOPE, Lookup, NORMAL_OFFSET};
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Params, Range as Values};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;
use std::ops::Range;

/// Texels a side.
const SIZE: ParamSpec = ParamSpec {
    name: "size",
    range: Values::U32 { min: 16, max: 16_384, default: 1024 },
    unit: "texels",
    doc: "side of each map: finer shadows as it grows, time and memory as its square",
};
/// Memory of the maps that exist at a time.
const MEMORY: ParamSpec = ParamSpec {
    name: "memory",
    range: Values::U32 { min: 1, max: 65_536, default: 128 },
    unit: "MiB",
    doc: "memory of the maps kept at a time, for one light sample at least and 32 at most: fewer passes over the view-samples as it grows",
};
/// View-samples that the faces of a light sample do not see.
const BEHIND: Counter = Counter {
    name: "behind",
    doc: "(kept view-sample, light sample) pairs that the light sample's faces do not look at",
    kind: CounterKind::MustBeZero("use light_frame six_faces"),
};

/// The pass.
pub static PASS: Pass = Pass {
    name: "multi_shadow_map",
    stage: &STAGE,
    doc: "A shadow map for each light sample, one comparison a bit.",
    source: "Heckbert, Herf 1997; Williams 1978",
    ignores: &[
        "triangle",
        "cell",
        "list_length",
        "list_far",
        "list_offset",
        "list_entries",
        "caster_offset",
        "caster_entries",
        "lu",
        "lu_layout",
        "bvh_nodes",
        "bvh_order",
        "penumbra_state",
    ],
    params: &[SIZE, MEMORY, BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET],
    counters: &[BEHIND],
    contract: Contract::Approximate,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let words = mask_words(cx.dim(input::LIGHT_SAMPLES.name, 0));
    vec![(ports::MASK.name, vec![cx.dim(ports::POSITION.name, 0), words])]
}

fn lookup(params: &Params) -> Lookup {
    Lookup {
        bias_constant: params.f32(BIAS_CONSTANT.name),
        bias_slope: params.f32(BIAS_SLOPE.name),
        normal_offset: params.f32(NORMAL_OFFSET.name),
        kernel: 1,
    }
}

/// Light samples whose maps of `face_count` faces exist at a time.
fn at_once(params: &Params, face_count: usize) -> usize {
    let side = params.u32(SIZE.name) as usize;
    let bytes = (params.u32(MEMORY.name) as usize) << 20;
    (bytes / (4 * face_count.max(1) * side * side)).clamp(1, 32)
}

/// Ranges of at most `at_once` light samples, each within one word of the mask.
fn ranges(light_count: usize, at_once: usize) -> impl Iterator<Item = Range<usize>> {
    let mut first = 0;
    std::iter::from_fn(move || {
        let end = (first + at_once).min(light_count).min((first / 32 + 1) * 32);
        let range = first..end;
        first = end;
        (!range.is_empty()).then_some(range)
    })
}
