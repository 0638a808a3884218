//! Stage `shade`: Visible fraction and light term to a picture (Sintorn 2008, section 4.3, Shading).

pub mod bent_lambert;
mod gpu;
mod params;
pub mod phong;
mod surface;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;
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
pub const PASSES: &[&Pass] = &[&bent_lambert::PASS, &phong::PASS];

/// Kept by every pass here.
const OUTSIDE: Counter = Counter {
    name: "outside",
    doc: "view-samples left out because their pixel is not in the picture",
    kind: CounterKind::Info,
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let [width, height] = cx.image;
    vec![(ports::IMAGE.name, vec![height, width, 4])]
}
