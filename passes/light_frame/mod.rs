//! Stage `light_frame`: Where the light looks and which window of its image is divided into texels (Sintorn 2008, section 4.3, Parametrization).

pub mod fitted;
pub mod six_faces;
pub mod whole;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "light_frame",
    doc: "Where the light looks and which window of its image is divided into texels (Sintorn 2008, section 4.3, Parametrization).",
    ports: &[
        ports::POSITION.read(),
        ports::SAMPLE_STATE.read(),
        input::LIGHT_SAMPLES.read(),
        input::SCENE_BOUNDS.read(),
        ports::LIGHT_FRAME,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&fitted::PASS, &whole::PASS, &six_faces::PASS];
