//! Stage `shade`: Visible fraction and light term to a picture (Sintorn 2008, section 4.3, Shading).
//!
//! The light that arrives at a view-sample is an integral over the light of visibility times lighting (equation (1) of the paper).
//! `phong` and `bent_lambert` are the factored form, which the paper takes: the visible share of the light times the lighting from
//! its centre. `full_sum` is the integral itself over the light samples. Where `visible_color` has rows it takes the place of
//! `visible`, channel by channel.
//!
//! On a GPU a picture is made by dispatches of at most eight storage buffers, WebGPU's minimum: where each view-sample's colour
//! goes, its light terms, its colour.

pub mod bent_lambert;
pub mod full_sum;
mod gpu;
mod params;
pub mod phong;
mod reflection;
mod surface;
#[cfg(test)]
mod tests;

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
        ports::VISIBLE_COLOR.optional(),
        ports::MASK.optional(),
        input::LIGHT_SAMPLES.optional(),
        input::LIGHT_WEIGHTS.optional(),
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
pub const PASSES: &[&Pass] = &[&bent_lambert::PASS, &phong::PASS, &full_sum::PASS];

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
