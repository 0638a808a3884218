//! `angles_distance`: for every bin of a plane's two angles and its distance, the light samples behind the plane in its middle.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 4.2: LU as a 3D texture over two angles and a distance, 128 light samples a texture, k of
//! them for k x 128. In: `light_samples [L 3]` world. Out: `lu [K size size size 4]`, `lu_layout [16]`, K = ceil(L / 128).
//! Coordinates and bins are those of [`crate::shared::lu`].
//!
//! Mirrored bins hold complements, bit for bit: opposite planes part the light samples between them. Takes K size^3 16 bytes; more than the
//! device binds, or than 2 GiB on the CPU, is an error that names a size that fits.

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
    name: "angles_distance",
    stage: &STAGE,
    doc: "Light samples behind the middle plane of every bin of two angles and a distance.",
    source: "Sintorn 2008, section 4.2",
    ignores: &[],
    params: &[ParamSpec {
        name: "size",
        range: Range::U32 { min: 32, max: 256, default: 128 },
        unit: "bins",
        doc: "bins along each coordinate, rounded up to an even number; wrong bits halve and memory grows eightfold as it doubles",
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
    vec![("lu", vec![blocks, size, size, size, 4]), ("lu_layout", vec![LAYOUT_WORDS])]
}
