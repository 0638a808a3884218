//! Which hits count: a triangle wholly at or below the plane of the view-sample's own triangle casts no shadow there.
//!
//! The rule is that of [`OwnPlane::admits`], bit for bit; f64 decides what its rounding cannot turn, which is nearly all.

use crate::shared::predicate::{Corners, OwnPlane};
use glam::DVec3;

/// Error of a height over the product of the three lengths it is made of: some twenty roundings of 2^-53, and the corners' own
/// differences are exact or as good.
const ERROR: f64 = 1e-14;

/// The plane of a view-sample's own triangle.
pub struct Plane<'a> {
    corners: &'a Corners,
    point: DVec3,
    normal: DVec3,
    /// Of a height, for each unit of distance from `point`.
    error: f64,
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

impl<'a> Plane<'a> {
    /// Of `corners`.
    pub fn new(corners: &'a Corners) -> Self {
        let [a, b, c] = corners.map(wide);
        let (e1, e2) = (b - a, c - a);
        let error = ERROR * e1.abs().element_sum() * e2.abs().element_sum();
        Self { corners, point: a, normal: e1.cross(e2), error }
    }

    /// 1 or -1: the side that `point` is on for certain; 0 where rounding could decide.
    #[inline]
    fn side(&self, point: [f32; 3]) -> i32 {
        let offset = wide(point) - self.point;
        let height = self.normal.dot(offset);
        let doubt = self.error * offset.abs().element_sum();
        i32::from(height > doubt) - i32::from(height < -doubt)
    }

    /// The side that all of a box is on for certain; 0 where it is not on one.
    pub fn side_of_box(&self, low: [f32; 3], high: [f32; 3]) -> i32 {
        let corner = |bits: usize| [0, 1, 2].map(|k| if bits >> k & 1 == 0 { low[k] } else { high[k] });
        let first = self.side(corner(0));
        if (1..8).all(|bits| self.side(corner(bits)) == first) { first } else { 0 }
    }

    /// Whether a hit of `caster` by a ray to `light` counts, where `light_side` is the light's side or 0 for not known.
    pub fn admits(&self, caster: &Corners, light: [f32; 3], light_side: i32) -> bool {
        (light_side != 0 && caster.iter().any(|corner| self.side(*corner) == light_side))
            || OwnPlane::new(self.corners, light).admits(caster)
    }
}
