//! Stage `penumbra`: Which view-samples may see a part of the light (Sintorn 2008, section 4.3, Restrict computations).

pub mod silhouettes;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "penumbra",
    doc: "Which view-samples may see a part of the light (Sintorn 2008, section 4.3, Restrict computations).",
    ports: &[
        input::TRIANGLES.read(),
        ports::CASTER_STATE.read(),
        ports::ACROSS.read(),
        input::LIGHT_SAMPLES.read(),
        ports::LIGHT_FRAME.read(),
        ports::POSITION.read(),
        ports::TRIANGLE.read(),
        ports::SAMPLE_STATE.read(),
        ports::CELL.read(),
        ports::LIST_LENGTH.read(),
        ports::LIST_FAR.read(),
        ports::PENUMBRA_STATE,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&silhouettes::PASS];
