//! Light terms, then colours.

use crate::shade::gpu::{CENTRE, COLOR, NUMBERS, REFLECTION, SURFACE, VISIBLE, record_factored};
use crate::shade::reflection::Reflection;
use crate::shared::shading;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::shared::PRELUDE;

const TERMS: &[&str] = &[PRELUDE, NUMBERS, shading::WGSL, SURFACE, CENTRE, REFLECTION, include_str!("kernel.wgsl")];
const COLORS: &[&str] = &[PRELUDE, NUMBERS, COLOR, VISIBLE, include_str!("color.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let Reflection { specular, shininess } = Reflection::new(cx.params());
    record_factored(cx, "shade/phong", [TERMS, COLORS], "phong", [specular, shininess], input::CAMERA.name);
    Ok(())
}
