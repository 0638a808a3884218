//! Five dispatches: origin, directions, axes, window, fit.

use crate::ports;
use crate::shared::light_fit::{self, bindings};
use crate::shared::light_frame;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind::ReadWrite, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] = &[PRELUDE, light_frame::WGSL, light_fit::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (mut bind, reduction) = bindings(cx, 1)?;
    bind.push(ReadWrite(Target::Counters));
    let invocations = light_fit::invocations(cx.dim(ports::POSITION.name, 0));
    cx.zero(reduction);
    for (label, entry, count) in [
        ("light_frame/fitted origin", "fitted_origin", 1),
        ("light_frame/fitted directions", "fitted_directions", invocations),
        ("light_frame/fitted axes", "fitted_axes", 1),
        ("light_frame/fitted window", "fitted_window", invocations),
        ("light_frame/fitted fit", "fitted_fit", 1),
    ] {
        cx.dispatch(label, PIECES, entry, bind.clone(), count, GROUP);
    }
    Ok(())
}
