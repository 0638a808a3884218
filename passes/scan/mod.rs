//! Stage `scan`: Exclusive prefix sum: lengths to offsets, row by row (Sintorn 2008, section 3.1).

pub mod serial;
pub mod work_efficient;

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "scan",
    doc: "Exclusive prefix sum: lengths to offsets, row by row (Sintorn 2008, section 3.1).",
    ports: &[ports::LENGTH.read(), ports::OFFSET],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&work_efficient::PASS, &serial::PASS];

/// One offset a cell, and the total.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::OFFSET.name, vec![cx.count(ports::LENGTH.name) + 1])]
}
