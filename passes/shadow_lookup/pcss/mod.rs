//! `pcss`: percentage-closer soft shadows (Fernando 2005). One shadow map from the light's centre; the blockers found about a
//! view-sample tell how wide its penumbra is, and percentage-closer filtering blurs by that much.
//!
//! In: `depth [F D D]`, `light_frame [F 20]`, `position [P 3]` world, `normal [P 3]` world, `sample_state [P]`, `light_samples [L 3]`, any
//! L, of which only the number is read, `light [8]`, of which only the radius is. Out: `visible [P]`, the share of filter taps that
//! are lit; `mask [P ceil(L/32)]`: so many of the lowest bits set that their share is `1 - visible`, rounded. Which light samples are
//! blocked the method cannot say. A view-sample facing away has all bits set and sees nothing; background has none and
//! sees all.
//!
//! With the light's radius R, the view-sample at depth w and blockers at depth d along the face's axis, the penumbra is
//! `R (w - d) / d` wide there, in the map's tangents `r(d) = R (1 / d - 1 / w)`. Step 1 averages the depths nearer than the
//! receiver's plane over `search_taps` within `r(nearest_blocker w)`; step 2 takes `r` of that mean; step 3 is the lit share of
//! `filter_taps` within it. Radii are cut at `largest_width` of the map's side, and are no less than half a texel in step 3. Taps
//! lie on a spiral of equal areas, the same for every view-sample.
//!
//! A tap is compared with the receiver's own plane at that tap, cut as in [`crate::shared::shadow_lookup`], less its bias; taps
//! outside the map, and beyond a face's edge, are lit.
//!
//! Fails where one depth cannot tell: blockers at several depths are averaged, blockers hidden from the light's centre are
//! missed, and half covers on either side of the light add up to a blur.

mod cpu;
mod gpu;
mod taps;
#[cfg(test)]
mod tests;

use crate::ports;
use crate::shared::segments::mask_words;
use crate::shared::shadow_lookup::{BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET};
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::size::SizeCx;
use taps::MOST_TAPS;

const SEARCH_TAPS: ParamSpec = ParamSpec {
    name: "search_taps",
    range: Range::U32 { min: 1, max: MOST_TAPS as u32, default: 32 },
    unit: "texels read",
    doc: "finds smaller blockers as it grows, time in proportion",
};
const FILTER_TAPS: ParamSpec = ParamSpec {
    name: "filter_taps",
    range: Range::U32 { min: 1, max: MOST_TAPS as u32, default: 64 },
    unit: "texels read",
    doc: "more grey levels and less banding as it grows, time in proportion",
};
const NEAREST_BLOCKER: ParamSpec = ParamSpec {
    name: "nearest_blocker",
    range: Range::F32 { min: 0.01, max: 1.0, default: 0.25 },
    unit: "share of the view-sample's depth",
    doc: "blockers nearer to the light than this are sought in too small a circle; the circle grows, and misses small blockers, as it falls",
};
const LARGEST_WIDTH: ParamSpec = ParamSpec {
    name: "largest_width",
    range: Range::F32 { min: 0.0, max: 1.0, default: 0.1 },
    unit: "share of the map's side, as a radius",
    doc: "wider penumbrae as it grows, and more banding in them",
};

/// The pass.
pub static PASS: Pass = Pass {
    name: "pcss",
    stage: &super::STAGE,
    doc: "A penumbra as wide as the blockers' mean depth says, by percentage-closer filtering.",
    source: "Fernando 2005",
    ignores: &[],
    params: &[SEARCH_TAPS, FILTER_TAPS, NEAREST_BLOCKER, LARGEST_WIDTH, BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let rows = cx.dim(ports::POSITION.name, 0);
    let words = mask_words(cx.dim(input::LIGHT_SAMPLES.name, 0));
    vec![(ports::MASK.name, vec![rows, words]), (ports::VISIBLE.name, vec![rows])]
}
