//! Stage `view_samples`: The surface points seen by the camera, one for each pixel (Sintorn 2008, section 3, overview).

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "view_samples",
    doc: "The surface points seen by the camera, one for each pixel (Sintorn 2008, section 3, overview).",
    ports: &[
        input::TRIANGLES.read(),
        input::CAMERA.read(),
        input::IMPORTED_POSITION.optional(),
        input::IMPORTED_NORMAL.optional(),
        input::IMPORTED_TRIANGLE.optional(),
        input::IMPORTED_PIXEL.optional(),
        ports::POSITION,
        ports::NORMAL,
        ports::TRIANGLE,
        ports::PIXEL,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
