//! Whether a triangle stands between a view-sample and a light sample: the definition of a hard shadow, decided exactly.
//!
//! All signs are those of `robust::orient3d` on the stored f32 values, so the answer is a function of their bits alone. With
//! P the view-sample, S the light sample and V0, V1, V2 the corners, and o(a, b, c, d) = sign det(a-d, b-d, c-d):
//!
//! - w = o(V0, V1, V2, P) is not 0: seen edge-on, or degenerate, a triangle never blocks;
//! - w o(S, Vk, Vk+1, P) >= 0 for k = 0, 1, 2: P is in the closed pyramid of S over the triangle. Both triangles at a shared
//!   edge or corner hold it, so no light leaks between them;
//! - w o(V0, V1, V2, S) <= 0: S is not on P's side of the plane;
//! - some corner lies strictly on S's side of the plane of the triangle that P lies on. A triangle wholly at or below that
//!   plane cannot shadow a point of it; this takes the place of a bias. It does not apply when S is in that plane.
//!
//! This file is the judge: no filters but those inside `orient3d`, which are exact. A triangle is never asked about
//! view-samples on itself: callers leave it out by its index.

use robust::{Coord3D, orient3d};

/// Corners of a triangle, world space.
pub type Corners = [[f32; 3]; 3];

/// An exact point.
type Exact = Coord3D<f64>;

fn exact(point: [f32; 3]) -> Exact {
    let [x, y, z] = point.map(f64::from);
    Exact { x, y, z }
}

/// -1, 0 or 1.
fn sign(value: f64) -> i32 {
    i32::from(value > 0.0) - i32::from(value < 0.0)
}

/// -1, 0 or 1: the side of the plane of `corners` that `point` is on; 0 in the plane, or for a degenerate triangle.
pub fn side(corners: &Corners, point: [f32; 3]) -> i32 {
    let [a, b, c] = corners.map(exact);
    sign(orient3d(a, b, c, exact(point)))
}

/// A caster seen from one light sample, with what does not depend on the view-sample.
#[derive(Clone, Copy, Debug)]
pub struct Pyramid {
    corners: [Exact; 3],
    light: Exact,
    light_side: i32,
}

impl Pyramid {
    /// `caster` seen from `light`.
    pub fn new(caster: &Corners, light: [f32; 3]) -> Self {
        Self { corners: caster.map(exact), light: exact(light), light_side: side(caster, light) }
    }

    /// Whether the segment from `position` to the light sample meets the closed triangle, ends as stated above.
    pub fn covers(&self, position: [f32; 3]) -> bool {
        let position = exact(position);
        let [a, b, c] = self.corners;
        let w = sign(orient3d(a, b, c, position));
        if w == 0 || w * self.light_side > 0 {
            return false;
        }
        [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| w * sign(orient3d(self.light, from, to, position)) >= 0)
    }
}

/// The plane of the triangle that a view-sample lies on, and the side of it that the light sample is on.
#[derive(Clone, Copy, Debug)]
pub struct OwnPlane {
    corners: Corners,
    light_side: i32,
}

impl OwnPlane {
    /// The plane of `own` as `light` sees it.
    pub fn new(own: &Corners, light: [f32; 3]) -> Self {
        Self { corners: *own, light_side: side(own, light) }
    }

    /// Whether some corner of `caster` is strictly on the light sample's side; true when that side is undefined.
    pub fn admits(&self, caster: &Corners) -> bool {
        self.light_side == 0 || caster.iter().any(|corner| side(&self.corners, *corner) == self.light_side)
    }
}

/// Whether `caster` blocks `light` at `position`, which lies on the triangle `own` (another than `caster`) or on none.
pub fn blocks(position: [f32; 3], own: Option<&Corners>, caster: &Corners, light: [f32; 3]) -> bool {
    Pyramid::new(caster, light).covers(position) && own.is_none_or(|own| OwnPlane::new(own, light).admits(caster))
}

#[cfg(test)]
#[path = "predicate_tests.rs"]
mod tests;
