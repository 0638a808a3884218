//! Directions and weights that lighting is made of, safe at every scale. [`WGSL`] holds the same operations in the same order.

use glam::Vec3;

/// The pieces below in WGSL.
pub const WGSL: &str = include_str!("shading.wgsl");

/// Corners of a triangle, world space.
pub type Corners = [[f32; 3]; 3];

/// `v` at length 1; zero stays zero. Scaled first: squares of 1e20 and 1e-23 leave the range of f32.
#[inline]
pub fn unit(v: Vec3) -> Vec3 {
    let largest = v.abs().max_element();
    if !(largest > 0.0 && largest < f32::INFINITY) {
        return Vec3::ZERO;
    }
    let scaled = v / largest;
    scaled / scaled.length()
}

/// Unit normal on the side from which the corners turn counter-clockwise; zero for a degenerate triangle.
#[inline]
pub fn face_normal(corners: &Corners) -> Vec3 {
    let [a, b, c] = corners.map(Vec3::from);
    let (e1, e2) = (b - a, c - a);
    let largest = e1.abs().max(e2.abs()).max_element();
    if !(largest > 0.0 && largest < f32::INFINITY) {
        return Vec3::ZERO;
    }
    unit((e1 / largest).cross(e2 / largest))
}

/// Weights of the corners at `at`, none negative, sum 1; a third each where the triangle has no area.
#[inline]
pub fn weights(corners: &Corners, at: Vec3) -> Vec3 {
    let [a, b, c] = corners.map(Vec3::from);
    let largest = (b - a).abs().max((c - a).abs()).max_element();
    if !(largest > 0.0 && largest < f32::INFINITY) {
        return Vec3::splat(1.0 / 3.0);
    }
    let (to_a, to_b, to_c) = ((a - at) / largest, (b - at) / largest, (c - at) / largest);
    let normal = ((b - a) / largest).cross((c - a) / largest);
    let areas = Vec3::new(normal.dot(to_b.cross(to_c)), normal.dot(to_c.cross(to_a)), normal.dot(to_a.cross(to_b)));
    let areas = areas.max(Vec3::ZERO);
    let sum = areas.x + areas.y + areas.z;
    if sum > 0.0 { areas / sum } else { Vec3::splat(1.0 / 3.0) }
}

/// The cosine between the direction from `at` to the light and a face's normal, -1..=1; 0 for a degenerate triangle.
#[inline]
pub fn face_cosine(corners: &Corners, at: [f32; 3], light: Vec3) -> f32 {
    unit(light - Vec3::from(at)).dot(face_normal(corners))
}

#[cfg(test)]
#[path = "shading_tests.rs"]
mod tests;
