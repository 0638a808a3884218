//! Stage `list_build`: Counts the view-samples of each light texel and gives each its place in the list (Sintorn 2008, section 3.1).

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "list_build",
    doc: "Counts the view-samples of each light texel and gives each its place in the list (Sintorn 2008, section 3.1).",
    ports: &[
        ports::POSITION.read(),
        ports::SAMPLE_STATE.read(),
        ports::LIGHT_FRAME.read(),
        ports::CELL,
        ports::SLOT,
        ports::LIST_LENGTH,
        ports::LIST_FAR,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
