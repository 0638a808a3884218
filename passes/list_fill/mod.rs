//! Stage `list_fill`: Writes each view-sample to its place in the one packed array (Sintorn 2008, section 3.1).

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "list_fill",
    doc: "Writes each view-sample to its place in the one packed array (Sintorn 2008, section 3.1).",
    ports: &[ports::CELL.read(), ports::SLOT.read(), ports::OFFSET.read().named("list_offset"), ports::LIST_ENTRIES],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
