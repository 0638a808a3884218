//! The light of one surface.

use crate::shade::surface::{Surface, picture};
use crate::shared::shading::unit;
use glam::Vec3;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// Reflected light but for visibility and ambient.
pub fn reflected(surface: &Surface, eye: Vec3, specular: f32, shininess: f32) -> Vec3 {
    let (n, l) = (surface.shading_normal, surface.toward_light);
    let cosine = n.dot(l);
    if cosine <= 0.0 {
        return Vec3::ZERO;
    }
    let mirrored = 2.0 * cosine * n - l;
    let highlight = specular * mirrored.dot(unit(eye - surface.position)).max(0.0).powf(shininess);
    surface.light * (surface.albedo * cosine + Vec3::splat(highlight))
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let [specular, shininess] = [super::SPECULAR, super::SHININESS].map(|spec| cx.params().f32(spec.name));
    let eye = Vec3::from_slice(&cx.input(input::CAMERA.name).as_f32()[..3]);
    picture(cx, |surface| reflected(surface, eye, specular, shininess));
    Ok(())
}
