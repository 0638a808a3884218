//! Three dispatches: axes and window from the corners, depths of the view-samples, fit.

use crate::ports;
use crate::shared::light_fit::{self, bindings};
use crate::shared::light_frame;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{
    Bind::{Read, ReadWrite},
    GpuCx,
    Target::{Counters, Port},
};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] = &[PRELUDE, light_frame::WGSL, light_fit::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (mut bind, reduction) = bindings(cx, 1)?;
    bind.push(ReadWrite(Counters));
    bind.push(Read(Port(input::SCENE_BOUNDS.name)));
    let invocations = light_fit::invocations(cx.dim(ports::POSITION.name, 0));
    cx.zero(reduction);
    for (label, entry, count) in [
        ("light_frame/whole corners", "whole_corners", 1),
        ("light_frame/whole depths", "whole_depths", invocations),
        ("light_frame/whole fit", "whole_fit", 1),
    ] {
        cx.dispatch(label, PIECES, entry, bind.clone(), count, GROUP);
    }
    Ok(())
}
