//! Stage `adjacency`: Which triangle lies across each edge of the casters (Sintorn 2008, section 4.3).

pub mod half_edges;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "adjacency",
    doc: "Which triangle lies across each edge of the casters (Sintorn 2008, section 4.3).",
    ports: &[input::TRIANGLES.read(), ports::CASTER_STATE.read(), ports::ACROSS],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&half_edges::PASS];
