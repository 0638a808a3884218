//! Stage `light_depth`: Depth of the casters seen from the light, the shadow map (Williams 1978).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "light_depth",
    doc: "Depth of the casters seen from the light, the shadow map (Williams 1978).",
    ports: &[input::TRIANGLES.read(), ports::CASTER_STATE.read(), ports::LIGHT_FRAME.read(), ports::DEPTH],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
