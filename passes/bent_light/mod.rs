//! Stage `bent_light`: The light term at corners that is black on every face turned away (Sintorn 2008, section 4.3, Shading).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "bent_light",
    doc: "The light term at corners that is black on every face turned away (Sintorn 2008, section 4.3, Shading).",
    ports: &[
        input::TRIANGLES.read(),
        input::CORNER_VERTEX.read(),
        input::FACE_OFFSET.read(),
        input::FACES.read(),
        input::LIGHT.read(),
        ports::CORNER_LIGHT,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
