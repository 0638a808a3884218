//! `certain_uncertain`: for every bin of a plane's two angles and its distance, the light samples that are surely behind every plane of the
//! bin, and those that may be behind one.
//!
//! After Sintorn, Eisemann, Assarsson 2008, section 4.2: what the table leaves open is decided by arithmetic, so answers are exact at the
//! speed of a table. In: `light_samples [L 3]` world. Out: `lu [K size size size 8]`, in each bin four words of certain light samples, then
//! four of possible ones, and `lu_layout [16]`, K = ceil(L / 128). Coordinates and bins are those of [`crate::shared::lu`].
//!
//! Conservative: certain and possible hold for every plane whose coordinates, erring by rounding and by the approximated angle, fall in
//! the bin ([`crate::shared::lu_fill::CERTAIN_SLACK`]). Mirrored bins exchange certain with not possible. Takes K size^3 32 bytes; more
//! than the device binds, or than 2 GiB on the CPU, is an error that names a size that fits.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::shared::lu::{BLOCK, LAYOUT_WORDS, even};
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "certain_uncertain",
    stage: &STAGE,
    doc: "Light samples surely, and possibly, behind every plane of each bin of two angles and a distance.",
    source: "Sintorn 2008, section 4.2; departs: certain and possible bits apart",
    ignores: &[],
    params: &[ParamSpec {
        name: "size",
        range: Range::U32 { min: 32, max: 256, default: 64 },
        unit: "bins",
        doc: "bins along each coordinate, rounded up to an even number; bits left to arithmetic halve and memory grows eightfold as it doubles",
    }],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let size = even(cx.params.u32("size"));
    let blocks = cx.dim("light_samples", 0).div_ceil(BLOCK);
    vec![("lu", vec![blocks, size, size, size, 8]), ("lu_layout", vec![LAYOUT_WORDS])]
}
