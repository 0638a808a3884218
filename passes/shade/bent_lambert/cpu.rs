//! The light term of one surface.

use crate::ports;
use crate::shade::surface::{Surface, picture};
use glam::Vec3;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// alpha l_f + (1 - alpha) max(l_bend, 0), 0..=1, from the three corners' l_bend.
pub fn light_term(surface: &Surface, corner_light: Vec3, c: f32) -> f32 {
    let smooth = surface.shading_normal.dot(surface.toward_light).max(0.0);
    let interpolated = surface.weights.dot(corner_light);
    let bent = if surface.is_flipped {
        (-interpolated).min(surface.geometric_normal.dot(surface.toward_light))
    } else {
        interpolated
    };
    let alpha = (c * bent).clamp(0.0, 1.0);
    alpha * smooth + (1.0 - alpha) * bent.max(0.0)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let c = cx.params().f32(super::SHARPNESS.name);
    let corner_light = cx.input(ports::CORNER_LIGHT.name).as_vec3();
    picture(cx, |_, surface| {
        let term = light_term(surface, Vec3::from(corner_light[surface.triangle]), c);
        surface.visible * (surface.albedo * surface.light * term)
    });
    Ok(())
}
