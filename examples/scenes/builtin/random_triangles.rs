//! Random triangles above a ground square.

use super::Builtin;
use super::shapes::{COOL, LIGHT, ground, light_at, look_from};
use crate::random::Random;
use crate::soup::Soup;
use glam::vec3;
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::scene::flag;

/// `builtin:random-triangles`.
pub const SCENE: Builtin = Builtin {
    name: "random-triangles",
    doc: "equilateral triangles at random in the box [-1,1] x [0.1,1.6] x [-1,1], edge sqrt(6/count): how cost grows",
    params: &[
        ParamSpec {
            name: "count",
            range: Range::U32 { min: 0, max: 8_000_000, default: 10_000 },
            unit: "triangles",
            doc: "triangles besides the ground's two",
        },
        ParamSpec {
            name: "seed",
            range: Range::U32 { min: 0, max: u32::MAX, default: 1 },
            unit: "",
            doc: "another draw",
        },
    ],
    build,
};

fn build(params: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    soup.start_shape();
    let count = params.u32("count");
    let edge = (6.0 / f64::from(count)).sqrt() as f32;
    let mut random = Random::new(params.u32("seed"));
    for _ in 0..count {
        let middle = vec3(random.range(-1.0, 1.0), random.range(0.1, 1.6), random.range(-1.0, 1.0));
        let normal = random.direction();
        let right = normal.any_orthonormal_vector();
        let ahead = normal.cross(right);
        let turn = random.range(0.0, std::f32::consts::TAU);
        // An equilateral triangle's corners lie edge / sqrt(3) from its middle.
        let corner = |third: f32| {
            let angle = turn + third * std::f32::consts::TAU / 3.0;
            let mut point = middle + (right * angle.cos() + ahead * angle.sin()) * (edge / 3.0_f32.sqrt());
            // Nothing reaches under the ground.
            point.y = point.y.max(0.0);
            point
        };
        soup.flat([corner(0.0), corner(1.0), corner(2.0)], COOL.with(flag::TWO_SIDED));
    }
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(2.6, 3.2, 4.2), vec3(0.0, 0.5, 0.0));
    soup
}
