//! `planar`: for every bin of an angle and an offset of a line in the light's plane, the light samples on its inner side.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 4.2, for planar lights, as Eisemann, Decoret 2007: a plane through a view-sample
//! and an edge matters only by the line where it meets the light's plane. In: `light_samples [L 3]` world, all in one plane. Out:
//! `lu [K size size 1 4]`, `lu_layout [16]` with the plane's axes and its offset from the middle of the light's box, K = ceil(L /
//! 128). Coordinates and bins are those of [`crate::shared::lu`].
//!
//! Light samples off the plane are refused, by the measure of the fact `light_is_planar`, which guards this pass in `choose`
//! ([`shadowgraph_core::light_plane`]); a GPU allows twice as much for its own rounding. Mirrored bins hold complements, bit for
//! bit. Takes K size^2 16 bytes.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::shared::lu::{BLOCK, LAYOUT_WORDS, even};
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "planar",
    stage: &STAGE,
    doc: "Light samples on the inner side of the middle line of every bin of an angle and an offset, for planar lights.",
    source: "Sintorn 2008, section 4.2; Eisemann, Decoret 2007",
    ignores: &[],
    params: &[ParamSpec {
        name: "size",
        range: Range::U32 { min: 32, max: 1024, default: 256 },
        unit: "bins",
        doc: "bins along each coordinate, rounded up to an even number; wrong bits halve and memory grows fourfold as it doubles",
    }],
    counters: &[Counter {
        name: "off_plane",
        doc: "light samples that lie off the light's plane",
        kind: CounterKind::MustBeZero("use lu_table=angles_distance with visibility=lu: the light is not planar"),
    }],
    contract: Contract::Approximate,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let size = even(cx.params.u32("size"));
    let blocks = cx.dim("light_samples", 0).div_ceil(BLOCK);
    vec![("lu", vec![blocks, size, size, 1, 4]), ("lu_layout", vec![LAYOUT_WORDS])]
}
