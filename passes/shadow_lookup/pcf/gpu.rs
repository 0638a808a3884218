//! One dispatch; 225 loop steps at most.

use crate::shared::{light_frame, shadow_lookup, shadow_map};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::shared::PRELUDE;

/// Everything the kernel is made of.
pub const PIECES: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    shadow_map::WGSL,
    shadow_lookup::WGSL,
    include_str!("../one_light_sample.wgsl"),
    include_str!("kernel.wgsl"),
];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let kernel = super::kernel(cx.params())?;
    super::super::dispatch(cx, "shadow_lookup/pcf", PIECES, "pcf", kernel)
}
