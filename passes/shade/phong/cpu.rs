//! Light from the centre.

use crate::shade::reflection::Reflection;
use crate::shade::surface::{picture, reflected};
use glam::Vec3;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let reflection = Reflection::new(cx.params());
    let eye = Vec3::from_slice(&cx.input(input::CAMERA.name).as_f32()[..3]);
    picture(cx, |_, surface| surface.visible * reflected(surface, eye, reflection));
    Ok(())
}
