//! Lights and cameras inside of things.

use super::Builtin;
use super::shapes::{COOL, GROUND, LEAF, WARM, board, cuboid, light_at, look_through, room, sphere};
use crate::random::Random;
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::Params;

/// `builtin:light-inside`.
pub const LIGHT_INSIDE: Builtin = Builtin {
    name: "light-inside",
    doc: "a light amid a room, with casters on all six sides and one a thousandth away",
    params: &[],
    build: light_inside,
};

/// `builtin:omni`.
pub const OMNI: Builtin = Builtin {
    name: "omni",
    doc: "a cubic room with 200 boxes around the light at its centre: its edges are the seams of the light's cube faces",
    params: &[],
    build: omni,
};

/// `builtin:camera-inside`.
pub const CAMERA_INSIDE: Builtin = Builtin {
    name: "camera-inside",
    doc: "a camera inside a closed box and a light outside of it: all in shadow, but for no light-back-facing triangle",
    params: &[],
    build: camera_inside,
};

fn light_inside(_: &Params) -> Soup {
    let mut soup = Soup::default();
    room(&mut soup, vec3(-2.0, 0.0, -2.0), vec3(2.0, 3.0, 2.0), GROUND);
    let light = vec3(0.1, 1.5, -0.05);
    for (axis, look) in [(Vec3::X, WARM), (Vec3::Y, COOL), (Vec3::Z, LEAF)] {
        for side in [-1.0, 1.0] {
            let middle = light + axis * (0.8 * side);
            cuboid(&mut soup, middle - Vec3::splat(0.15), middle + Vec3::splat(0.15), look);
        }
    }
    // Half under the light, so that only part of the floor is dark.
    board(&mut soup, light + vec3(0.02, -1e-3, 0.01), 0.02, WARM);
    light_at(&mut soup, light, 0.05);
    look_through(&mut soup, vec3(-1.8, 2.4, 1.8), vec3(0.3, 0.9, -0.3), 70.0);
    soup
}

fn omni(_: &Params) -> Soup {
    let mut soup = Soup::default();
    room(&mut soup, Vec3::splat(-2.0), Vec3::splat(2.0), GROUND);
    let mut random = Random::new(1);
    let mut boxes = 0;
    while boxes < 200 {
        let middle = vec3(random.range(-1.9, 1.9), random.range(-1.9, 1.9), random.range(-1.9, 1.9));
        let half = vec3(random.range(0.02, 0.1), random.range(0.02, 0.1), random.range(0.02, 0.1));
        // Not around the light, and not around the eye.
        if middle.length() > 0.5 && middle.distance(vec3(-1.6, 1.2, 1.6)) > 0.6 {
            cuboid(&mut soup, middle - half, middle + half, [WARM, COOL, LEAF][boxes % 3]);
            boxes += 1;
        }
    }
    light_at(&mut soup, Vec3::ZERO, 0.05);
    look_through(&mut soup, vec3(-1.6, 1.2, 1.6), vec3(0.6, -0.4, -0.6), 80.0);
    soup
}

fn camera_inside(_: &Params) -> Soup {
    let mut soup = Soup::default();
    cuboid(&mut soup, vec3(-2.0, 0.0, -2.0), vec3(2.0, 2.0, 2.0), GROUND);
    sphere(&mut soup, vec3(0.0, 0.6, 0.0), 0.4, 32, 16, COOL);
    cuboid(&mut soup, vec3(0.6, 0.0, -0.8), vec3(1.0, 0.9, -0.4), WARM);
    light_at(&mut soup, vec3(0.8, 4.5, -0.6), 0.25);
    look_through(&mut soup, vec3(-1.7, 1.6, 1.7), vec3(0.2, 0.5, 0.0), 60.0);
    soup
}
