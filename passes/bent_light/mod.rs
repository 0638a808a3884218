//! Stage `bent_light`: The light term at corners that is black on every face turned away (Sintorn 2008, section 4.3, Shading).

pub mod adjacent_faces;
mod around;
pub mod bounding_box;
pub mod own_face;

use crate::ports;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
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
        input::LIGHT_SAMPLES.read(),
        ports::CORNER_LIGHT,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&adjacent_faces::PASS, &bounding_box::PASS, &own_face::PASS];

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::CORNER_LIGHT.name, vec![cx.dim(input::TRIANGLES.name, 0), 3])]
}

/// Centre of the light.
fn centre(light: &Array) -> Vec3 {
    Vec3::from_slice(&light.as_f32()[..3])
}
