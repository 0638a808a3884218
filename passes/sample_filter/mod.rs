//! Stage `sample_filter`: Which view-samples need an answer (Sintorn 2008, section 3, Figure 2).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "sample_filter",
    doc: "Which view-samples need an answer (Sintorn 2008, section 3, Figure 2).",
    ports: &[
        ports::POSITION.read(),
        ports::NORMAL.read(),
        ports::TRIANGLE.read(),
        input::LIGHT_SAMPLES.read(),
        ports::SAMPLE_STATE,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
