//! Pass `light_frame/whole`: one face that sees the whole scene, whatever the camera sees: the plain light frustum.
//!
//! In: `position [P 3] f32, world`, `sample_state [P] u32`, `light_samples [L 3] f32, world`, `scene_bounds [2 3] f32, world`.
//! Out: `light_frame [1 20] f32, world`.
//!
//! The face looks to the middle of the scene's bounds; its window holds their eight corners, or reaches to a tangent of 8
//! where a corner lies beside or behind the light. Near and far are the depths of the corners (near at least a ten-thousandth
//! of far), widened to those of the view-samples where these lie outside. View-samples serve for that, for `valid`, and
//! for the count of those `behind`.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use crate::shared::light_fit::BEHIND;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::shared::FACE_WORDS;
use shadowgraph_core::size::SizeCx;

/// One face over the whole scene.
pub static PASS: Pass = Pass {
    name: "whole",
    stage: &super::STAGE,
    doc: "One face that sees the scene's whole bounding box.",
    source: "Sintorn 2008, section 3.1",
    ignores: &[],
    params: &[],
    counters: &[BEHIND],
    contract: Contract::Within(1e-3),
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(_: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::LIGHT_FRAME.name, vec![1, FACE_WORDS])]
}
