//! Stage `light_depth`: Depth of the casters seen from the light, the shadow map (Williams 1978).

pub mod first_surface;
pub mod second_surface;

use crate::ports;
use shadowgraph_core::array::Array;
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "light_depth",
    doc: "Depth of the casters seen from the light, the shadow map (Williams 1978).",
    ports: &[input::TRIANGLES.read(), ports::CASTER_STATE.read(), ports::LIGHT_FRAME.read(), ports::DEPTH],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&first_surface::PASS, &second_surface::PASS];

/// The parameter of all passes of this stage.
const SIZE: ParamSpec = ParamSpec {
    name: "size",
    range: Range::U32 { min: 16, max: 16_384, default: 2048 },
    unit: "texels",
    doc: "side of each face's map: finer shadows as it grows, time and memory as its square",
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let side = cx.params.u32(SIZE.name) as usize;
    vec![(ports::DEPTH.name, vec![cx.dim(ports::LIGHT_FRAME.name, 0), side, side])]
}

/// The output of `layers` of `side` x `side` texels.
fn depth_array(layers: usize, side: usize, depth: Vec<f32>) -> Array {
    Array::f32([layers, side, side], depth)
}
