//! Three dispatches: axes, window, fit.

use super::FACES;
use crate::ports;
use crate::shared::light_fit::{self, bindings};
use crate::shared::light_frame;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind::ReadWrite, Bind::Uniform, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] = &[PRELUDE, light_frame::WGSL, light_fit::WGSL, include_str!("kernel.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (mut bind, reduction) = bindings(cx, FACES)?;
    bind.push(ReadWrite(Target::Counters));
    bind.push(Uniform(vec![u32::from(cx.params().bool("fit")), 0, 0, 0]));
    let invocations = light_fit::invocations(cx.dim(ports::POSITION.name, 0));
    cx.zero(reduction);
    for (label, entry, count) in [
        ("light_frame/six_faces axes", "six_faces_axes", FACES),
        ("light_frame/six_faces window", "six_faces_window", invocations),
        ("light_frame/six_faces fit", "six_faces_fit", FACES),
    ] {
        cx.dispatch(label, PIECES, entry, bind.clone(), count, GROUP);
    }
    Ok(())
}
