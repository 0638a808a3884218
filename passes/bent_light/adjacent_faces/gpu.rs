//! Entries of `faces`, then corners.

use crate::bent_light::around;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{GpuCx, Target};
use shadowgraph_core::shared::PRELUDE;

const PIECES: &[&str] = &[PRELUDE, shading::WGSL, around::WGSL, include_str!("kernel.wgsl")];
const STEPS: around::Steps = [
    ("bent_light/adjacent_faces: entries", "adjacent_faces_step"),
    ("bent_light/adjacent_faces: corners", "adjacent_faces"),
];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    around::record(cx, PIECES, STEPS, Target::Port(input::LIGHT.name));
    Ok(())
}
