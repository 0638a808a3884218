//! Light terms, then colours.

use crate::ports;
use crate::shade::gpu::{CENTRE, COLOR, NUMBERS, SURFACE, VISIBLE, record_factored};
use crate::shared::shading;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::shared::PRELUDE;

const TERMS: &[&str] = &[PRELUDE, NUMBERS, shading::WGSL, SURFACE, CENTRE, include_str!("kernel.wgsl")];
const COLORS: &[&str] = &[PRELUDE, NUMBERS, COLOR, VISIBLE, include_str!("color.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let own = [cx.params().f32(super::SHARPNESS.name), 0.0];
    record_factored(cx, "shade/bent_lambert", [TERMS, COLORS], "bent_lambert", own, ports::CORNER_LIGHT.name);
    Ok(())
}
