//! Stage `casters`: Which triangles can cast a shadow that is not cast by another (Sintorn 2008, section 3.3).

pub mod all;
pub mod light_back_facing;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "casters",
    doc: "Which triangles can cast a shadow that is not cast by another (Sintorn 2008, section 3.3).",
    ports: &[input::TRIANGLES.read(), input::TRIANGLE_FLAGS.read(), input::LIGHT_SAMPLES.read(), ports::CASTER_STATE],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&all::PASS, &light_back_facing::PASS];

/// One state a triangle.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::CASTER_STATE.name, vec![cx.dim(input::TRIANGLES.name, 0)])]
}
