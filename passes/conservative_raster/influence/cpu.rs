//! Casters in parallel; each walks its influence region and claims a slot in every cell that matters.

use crate::shared::face_light::Bounds;
use crate::shared::influence::face_lights;
use crate::shared::light_bound::Shape;
use crate::shared::pair_walk::{MOST_PAIRS, put_pairs, sides};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::Problem;

/// Shape and bounds that the parameters ask for.
pub(super) fn bounds(params: &Params) -> (Shape, Bounds) {
    let bound = params.word("bound");
    let shape = if bound == "ellipsoid" { Shape::Ellipsoid } else { Shape::Sphere };
    (shape, Bounds { sides: params.u32("sides") as usize, is_quad: bound == "quad", cut: params.bool("cut") })
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let sides = sides(cx);
    let (shape, bounds) = bounds(cx.params());
    let samples = cx.input("light_samples").as_vec3();
    let lights = face_lights(&sides, samples, shape, bounds);
    put_pairs(cx, MOST_PAIRS, &sides, |index, caster| {
        let side = &sides[index];
        lights[index].region(&side.space.corners(caster), &side.grid)
    })
}
