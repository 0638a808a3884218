//! Pass `combine/popcount`: the share of light samples whose bit is not set (Sintorn 2008, section 4.2).
//!
//! In: `mask [P,M] u32` with M = ceil(L/32), `sample_state [P] u32`, the number L of `light_samples`. Out:
//! `visible [P] f32`, `visible = (L - bits set) / L`, 0 umbra to 1 lit; 1 for background and where there is no light sample.
//! With one light sample it is 0 or 1 exactly. Bits past the last light sample are not counted.
//! `visible_color` has no rows: a uniform light has one colour.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// Counts bits.
pub static PASS: Pass = Pass {
    name: "popcount",
    stage: &super::STAGE,
    doc: "The share of light samples that are not blocked.",
    source: "Sintorn 2008, section 4.2",
    ignores: &["light_weights"],
    params: &[],
    counters: &[],
    // A device may divide with an error of two and a half units in the last place.
    contract: Contract::Within(3e-7),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
