//! Stage `scan`: Exclusive prefix sum: lengths to offsets, row by row (Sintorn 2008, section 3.1).

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "scan",
    doc: "Exclusive prefix sum: lengths to offsets, row by row (Sintorn 2008, section 3.1).",
    ports: &[ports::LENGTH.read(), ports::OFFSET],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
