//! Pass `light_frame/fitted`: one face, turned to the kept view-samples and cut to the 2D bounding box of their projections,
//! with near and far fitted to their depths (Sintorn 2008, section 4.3, Parametrization).
//!
//! In: `position [P 3] f32, world`, `sample_state [P] u32`, `light_samples [L 3] f32, world`. Out: `light_frame [1 20] f32, world`.
//!
//! Two reductions over the view-samples. The first bounds their directions on the cube around the light; the face looks to
//! the middle of that box. The second bounds (u, v, depth). The window is padded by a hundred-thousandth of itself and by
//! the rounding of the projection, near and far by a hundred-thousandth, so every placed view-sample lies strictly inside;
//! it reaches at most to a tangent of 8, and what lies beyond goes to border texels.
//!
//! After it: `valid` iff a view-sample was kept; every word is finite. Kept view-samples beside or behind the face are
//! counted (`behind`): the light has samples all around it and wants `six_faces`.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use crate::shared::light_fit::BEHIND;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::shared::FACE_WORDS;
use shadowgraph_core::size::SizeCx;

/// One face fitted to the view-samples.
pub static PASS: Pass = Pass {
    name: "fitted",
    stage: &super::STAGE,
    doc: "One face with window, near and far fitted to the kept view-samples.",
    source: "Sintorn 2008, section 4.3, Parametrization",
    ignores: &[input::SCENE_BOUNDS.name],
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
