//! The cosine with the direction to the light's centre.

use crate::bent_light::{around, centre};
use crate::shared::shading::unit;
use glam::Vec3;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// The cosine between a face's normal and the direction from `at` to `light`.
pub fn cosine(normal: Vec3, at: Vec3, light: Vec3) -> f32 {
    unit(light - at).dot(normal)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let light = centre(cx.input(input::LIGHT.name));
    around::run(cx, |normal, at| cosine(normal, at, light));
    Ok(())
}
