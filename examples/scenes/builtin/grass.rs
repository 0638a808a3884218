//! Blades of grass: in a ring, and as a lawn.

use super::Builtin;
use super::shapes::{LEAF, ground, light_at, look_from};
use crate::random::Random;
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::scene::flag;

const SEED: ParamSpec =
    ParamSpec { name: "seed", range: Range::U32 { min: 0, max: u32::MAX, default: 1 }, unit: "", doc: "another draw" };

/// `builtin:grass-ring`.
pub const RING: Builtin = Builtin {
    name: "grass-ring",
    doc: "blades in a ring around a low light: long thin shadows in all directions",
    params: &[
        ParamSpec {
            name: "blades",
            range: Range::U32 { min: 1, max: 500_000, default: 4000 },
            unit: "blades",
            doc: "three triangles each",
        },
        SEED,
    ],
    build: ring,
};

/// `builtin:depth-noise`.
pub const LAWN: Builtin = Builtin {
    name: "depth-noise",
    doc: "a lawn seen at a low angle: neighbouring pixels at unrelated depths, so lists and tiles are of no help",
    params: &[
        ParamSpec {
            name: "count",
            range: Range::U32 { min: 1, max: 1_000_000, default: 200_000 },
            unit: "blades",
            doc: "three triangles each",
        },
        SEED,
    ],
    build: lawn,
};

/// A bent blade: two triangles and a tip.
fn blade(soup: &mut Soup, random: &mut Random, root: Vec3, height: f32) {
    let turn = random.range(0.0, std::f32::consts::TAU);
    let side = vec3(turn.cos(), 0.0, turn.sin()) * height * 0.04;
    let lean = vec3(random.range(-0.35, 0.35), 0.0, random.range(-0.35, 0.35)) * height;
    let middle = root + 0.5 * height * Vec3::Y + 0.3 * lean;
    let tip = root + height * Vec3::Y + lean;
    let look = LEAF.with(flag::TWO_SIDED);
    soup.flat([root - side, root + side, middle + side * 0.8], look);
    soup.flat([root - side, middle + side * 0.8, middle - side * 0.8], look);
    soup.flat([middle - side * 0.8, middle + side * 0.8, tip], look);
}

fn ring(params: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    soup.start_shape();
    let mut random = Random::new(params.u32("seed"));
    for _ in 0..params.u32("blades") {
        let turn = random.range(0.0, std::f32::consts::TAU);
        let radius = random.range(0.9, 1.5);
        let height = random.range(0.15, 0.4);
        blade(&mut soup, &mut random, vec3(radius * turn.cos(), 0.0, radius * turn.sin()), height);
    }
    light_at(&mut soup, vec3(0.1, 1.2, 0.05), 0.1);
    look_from(&mut soup, vec3(0.5, 4.6, 4.4), Vec3::ZERO);
    soup
}

fn lawn(params: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 4.0, 0.0);
    soup.start_shape();
    let mut random = Random::new(params.u32("seed"));
    for _ in 0..params.u32("count") {
        let root = vec3(random.range(-3.0, 3.0), 0.0, random.range(-3.0, 3.0));
        let height = random.range(0.1, 0.3);
        blade(&mut soup, &mut random, root, height);
    }
    light_at(&mut soup, vec3(2.0, 4.5, -1.5), 0.25);
    look_from(&mut soup, vec3(0.3, 0.9, 4.4), vec3(0.0, 0.1, 0.0));
    soup
}
