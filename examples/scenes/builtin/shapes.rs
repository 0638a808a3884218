//! Shapes that scenes are made of. All are counter-clockwise seen from outside.

use crate::soup::{Look, Soup};
use glam::{Vec3, vec3};
use shadowgraph_core::scene::{Camera, Light, LightShape, flag};
use std::f32::consts::TAU;

/// Look of receivers.
pub const GROUND: Look = Look::new(0.7, 0.7, 0.68);
/// Look of the first kind of caster.
pub const WARM: Look = Look::new(0.78, 0.5, 0.32);
/// Look of the second kind of caster.
pub const COOL: Look = Look::new(0.36, 0.55, 0.72);
/// Look of the third kind of caster.
pub const LEAF: Look = Look::new(0.32, 0.6, 0.28);
/// Light of the scenes that name no other.
pub const LIGHT: Vec3 = vec3(0.8, 4.5, -0.6);

/// The scene's camera, 40 degrees high.
pub fn look_from(soup: &mut Soup, eye: Vec3, target: Vec3) {
    look_through(soup, eye, target, 40.0);
}

/// The scene's camera with a full vertical angle in degrees.
pub fn look_through(soup: &mut Soup, eye: Vec3, target: Vec3, degrees: f32) {
    soup.cameras.push(Camera {
        name: "default".into(),
        eye: eye.to_array(),
        target: target.to_array(),
        up: [0.0, 1.0, 0.0],
        fov_y: degrees.to_radians(),
    });
}

/// The scene's light, white, with the radius that soft shadows use.
pub fn light_at(soup: &mut Soup, position: Vec3, radius: f32) {
    soup.lights.push(Light::sphere("default", position.to_array(), radius));
}

/// The scene's light, white, a horizontal rectangle with these half sides along x and z.
pub fn rectangle_light_at(soup: &mut Soup, centre: Vec3, [x, z]: [f32; 2]) {
    let half_axes = [[x, 0.0, 0.0], [0.0, 0.0, -z]];
    soup.lights.push(Light::shaped("default", centre.to_array(), LightShape::Rectangle { half_axes }));
}

/// The quad a, b, c, d, split along a-c.
pub fn quad(soup: &mut Soup, [a, b, c, d]: [Vec3; 4], look: Look) {
    soup.flat([a, b, c], look);
    soup.flat([a, c, d], look);
}

/// A square in the plane y = `height`, facing up, `half` to each side of the y axis.
pub fn ground(soup: &mut Soup, half: f32, height: f32) {
    soup.start_shape();
    let corner = |x: f32, z: f32| vec3(x * half, height, z * half);
    quad(soup, [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)], GROUND);
}

/// A box between two corners.
pub fn cuboid(soup: &mut Soup, low: Vec3, high: Vec3, look: Look) {
    soup.start_shape();
    let corner = |bits: usize| {
        let pick = |axis: usize| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] };
        vec3(pick(0), pick(1), pick(2))
    };
    for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
        quad(soup, face.map(corner), look);
    }
}

/// A closed solid around the y axis: rings of `sides` points at (height, radius at an angle), bottom to top, flat caps.
pub fn turned(soup: &mut Soup, sides: u32, heights: &[f32], point: impl Fn(f32, f32) -> Vec3, look: Look) {
    soup.start_shape();
    // The ring closes on the very same bits because its last point is its first.
    let at = |ring: usize, side: u32| point(heights[ring], (side % sides) as f32 / sides as f32 * TAU);
    let top = heights.len() - 1;
    for ring in 0..top {
        for side in 0..sides {
            quad(soup, [at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)], look);
        }
    }
    for side in 1..sides - 1 {
        soup.flat([at(0, 0), at(0, side + 1), at(0, side)], look);
        soup.flat([at(top, 0), at(top, side), at(top, side + 1)], look);
    }
}

/// A box seen from inside: its faces point inwards.
pub fn room(soup: &mut Soup, low: Vec3, high: Vec3, look: Look) {
    let start = soup.positions.len();
    cuboid(soup, low, high, look);
    for corners in &mut soup.positions[start..] {
        corners.swap(1, 2);
    }
    for normals in &mut soup.normals[start..] {
        *normals = normals.map(|normal| normal.map(|x| -x));
    }
}

/// A sphere of flat facets with smooth normals, closed: `slices` around, `stacks` from pole to pole.
pub fn sphere(soup: &mut Soup, middle: Vec3, radius: f32, slices: u32, stacks: u32, look: Look) {
    soup.start_shape();
    let normal = |stack: u32, slice: u32| match stack {
        0 => -Vec3::Y,
        stack if stack == stacks => Vec3::Y,
        stack => {
            let (high, turn) =
                (stack as f32 / stacks as f32 * TAU / 2.0, (slice % slices) as f32 / slices as f32 * TAU);
            vec3(high.sin() * turn.sin(), -high.cos(), high.sin() * turn.cos())
        }
    };
    let mut push = |corners: [(u32, u32); 3]| {
        let normals = corners.map(|(stack, slice)| normal(stack, slice));
        soup.smooth(normals.map(|normal| middle + radius * normal), normals.map(Vec3::normalize), look);
    };
    for stack in 0..stacks {
        for slice in 0..slices {
            let [a, b] = [(stack, slice), (stack, slice + 1)];
            let [c, d] = [(stack + 1, slice + 1), (stack + 1, slice)];
            if stack > 0 {
                push([a, b, c]);
            }
            if stack + 1 < stacks {
                push([a, c, d]);
            }
        }
    }
}

/// A closed straight bar between two points, flat sides and caps.
pub fn bar(soup: &mut Soup, [from, to]: [Vec3; 2], radius: f32, sides: u32, look: Look) {
    soup.start_shape();
    let along = (to - from).normalize();
    let right = along.any_orthonormal_vector();
    let ahead = along.cross(right);
    let at = |end: Vec3, side: u32| {
        let angle = (side % sides) as f32 / sides as f32 * TAU;
        end + radius * (right * angle.cos() + ahead * angle.sin())
    };
    for side in 0..sides {
        quad(soup, [at(from, side), at(from, side + 1), at(to, side + 1), at(to, side)], look);
    }
    for side in 1..sides - 1 {
        soup.flat([at(from, 0), at(from, side + 1), at(from, side)], look);
        soup.flat([at(to, 0), at(to, side), at(to, side + 1)], look);
    }
}

/// A horizontal square that faces up, open, lit and casting from both sides.
pub fn board(soup: &mut Soup, middle: Vec3, half: f32, look: Look) {
    soup.start_shape();
    let corner = |x: f32, z: f32| middle + vec3(x * half, 0.0, z * half);
    quad(
        soup,
        [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)],
        look.with(flag::TWO_SIDED),
    );
}
