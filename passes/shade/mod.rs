//! Stage `shade`: Visible fraction and light term to a picture (Sintorn 2008, section 4.3, Shading).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "shade",
    doc: "Visible fraction and light term to a picture (Sintorn 2008, section 4.3, Shading).",
    ports: &[
        ports::POSITION.read(),
        ports::NORMAL.read(),
        ports::TRIANGLE.read(),
        ports::PIXEL.read(),
        ports::SAMPLE_STATE.read(),
        ports::VISIBLE.read(),
        input::TRIANGLES.read(),
        input::TRIANGLE_NORMALS.read(),
        input::TRIANGLE_ALBEDO.read(),
        ports::CORNER_LIGHT.read(),
        input::CAMERA.read(),
        input::LIGHT.read(),
        ports::IMAGE,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
