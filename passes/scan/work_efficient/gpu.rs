//! The recipe that other passes use too.

use crate::ports;
use crate::shared::scan::record_scan;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{GpuCx, Target::Port};

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.words(ports::LENGTH.name);
    record_scan(cx, Port(ports::LENGTH.name), count, Port(ports::OFFSET.name));
    Ok(())
}
