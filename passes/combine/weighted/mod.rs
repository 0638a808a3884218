//! Pass `combine/weighted`: the share of a textured or coloured light that is not blocked (Sintorn 2008, sections 4 and 4.2: "textured
//! light sources"), each light sample counted as its weight says.
//!
//! In: `mask [P,M] u32` with M = ceil(L/32), `sample_state [P] u32`, `light_weights [L,3] f32` (linear RGB, not negative). Out:
//! `visible_color [P,3] f32`, the sum of the weights whose bit is not set, channel by channel; with weights that sum to 1 a share
//! 0..1, and `light` times it is the light that arrives. `visible [P] f32`, the share of the luminance:
//! `visible = Y(visible_color) / Y(sum of all weights)` with Y = 0.2126 red + 0.7152 green + 0.0722 blue (ITU-R BT.709, linear), 0
//! umbra to 1 lit, both ends exact. Background sees all of the light, and `visible` is 1 where the weights have no luminance.
//! Bits past the last light sample do not count.
//!
//! Sums are made word by word, in order, so that 4096 light samples carry at most 160 roundings: with uniform weights `visible` is
//! within 1e-5 of `popcount`. On a GPU one invocation takes at most one loop step a light sample; more than the most that is
//! allowed are refused.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::size::SizeCx;

/// Adds weights.
pub static PASS: Pass = Pass {
    name: "weighted",
    stage: &super::STAGE,
    doc: "The share of the light's weights that is not blocked: its luminance, and each channel.",
    source: "Sintorn 2008, sections 4 and 4.2",
    ignores: &["light_samples"],
    params: &[],
    counters: &[],
    contract: Contract::Within(1e-5),
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let rows = cx.dim(ports::SAMPLE_STATE.name, 0);
    vec![(ports::VISIBLE.name, vec![rows]), (ports::VISIBLE_COLOR.name, vec![rows, 3])]
}

/// Every weight must have its bit.
fn check_weights(weights: usize, words: usize) -> Result<(), Problem> {
    if weights.div_ceil(32) == words {
        return Ok(());
    }
    Err(Problem::new(Kind::BadValue, "the light's weights are not those of its samples")
        .port(input::LIGHT_WEIGHTS.name)
        .expected(format!("as many rows as light samples, which fill {words} mask words"))
        .found(format!("{weights} rows"))
        .remedy("supply one row of light_weights for each of light_samples"))
}
