//! Stage `shadow_lookup`: Compares each view-sample with the shadow map (Williams 1978; Reeves 1987).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "shadow_lookup",
    doc: "Compares each view-sample with the shadow map (Williams 1978; Reeves 1987).",
    ports: &[
        ports::DEPTH.read(),
        ports::LIGHT_FRAME.read(),
        ports::POSITION.read(),
        ports::NORMAL.read(),
        ports::SAMPLE_STATE.read(),
        input::LIGHT_SAMPLES.read(),
        ports::MASK,
        ports::VISIBLE,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
