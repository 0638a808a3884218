//! Stage `casters`: Which triangles can cast a shadow that is not cast by another (Sintorn 2008, section 3.3).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "casters",
    doc: "Which triangles can cast a shadow that is not cast by another (Sintorn 2008, section 3.3).",
    ports: &[input::TRIANGLES.read(), input::TRIANGLE_FLAGS.read(), input::LIGHT_SAMPLES.read(), ports::CASTER_STATE],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
