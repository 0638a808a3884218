//! Frames of small movements, for what flickers.

use super::Builtin;
use super::shapes::{COOL, LEAF, WARM, bar, board, cuboid, ground, light_at, look_from, sphere};
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};

const FRAME: ParamSpec = ParamSpec {
    name: "frame",
    range: Range::U32 { min: 0, max: 359, default: 0 },
    unit: "frames",
    doc: "since the start",
};

/// `builtin:anim-light`.
pub const LIGHT: Builtin = Builtin {
    name: "anim-light",
    doc: "the light goes around by a degree a frame",
    params: &[FRAME],
    build: orbiting_light,
};

/// `builtin:anim-cam`.
pub const CAMERA: Builtin = Builtin {
    name: "anim-cam",
    doc: "the camera slides by a tenth of a pixel (at 512 x 512) a frame: equal view-samples must get equal answers",
    params: &[FRAME],
    build: sliding_camera,
};

const EYE: Vec3 = vec3(2.2, 2.6, 4.2);
const TARGET: Vec3 = vec3(0.0, 0.4, 0.0);

fn orbiting_light(params: &Params) -> Soup {
    let mut soup = still_life();
    let turn = (params.u32("frame") as f32).to_radians();
    light_at(&mut soup, vec3(2.0 * turn.cos(), 4.5, 2.0 * turn.sin()), 0.25);
    look_from(&mut soup, EYE, TARGET);
    soup
}

fn sliding_camera(params: &Params) -> Soup {
    let mut soup = still_life();
    light_at(&mut soup, super::shapes::LIGHT, 0.25);
    let forward = TARGET - EYE;
    // A pixel at the target's distance.
    let pixel = 2.0 * forward.length() * 20.0_f32.to_radians().tan() / 512.0;
    let slide = forward.cross(Vec3::Y).normalize() * (0.1 * pixel * params.u32("frame") as f32);
    look_from(&mut soup, EYE + slide, TARGET + slide);
    soup
}

fn still_life() -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    cuboid(&mut soup, vec3(-1.0, 0.0, -0.6), vec3(-0.4, 0.9, 0.0), WARM);
    sphere(&mut soup, vec3(0.5, 0.5, 0.2), 0.4, 32, 16, COOL);
    for pole in 0..6 {
        let foot = vec3(-0.9 + 0.35 * pole as f32, 0.0, 0.9);
        bar(&mut soup, [foot, foot + Vec3::Y * 0.7], 0.01, 8, LEAF);
    }
    board(&mut soup, vec3(0.6, 1.5, -0.6), 0.3, LEAF);
    soup
}
