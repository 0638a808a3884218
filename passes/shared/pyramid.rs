//! A caster as one face of the light frame sees it: three planes through the light sample and the edges, and the supporting
//! plane, with bounds on their rounding.
//!
//! Light space is the image of world space under the face's axes: a linear map, so signs of determinants survive it even
//! though stored axes are orthonormal only to f32 rounding. There the light sample is the origin, and a view-sample P at
//! (u, v) with depth 1/q is (u, v, 1)/q. For corners a_k, with n_k = a_k x (a_k+1 - a_k), N = (a_1 - a_0) x (a_2 - a_0),
//! D = a_0 . N and all signs turned so that D > 0, P is blocked when
//!
//! - n_k . (u, v, 1) >= 0 for k = 0, 1, 2 (inside the pyramid), and
//! - N . (u, v, 1) - D q > 0 (behind the supporting plane),
//!
//! which are the conditions of [`crate::shared::predicate`]. Edge vectors are differences of corners, taken before anything
//! else: a tiny triangle far from the light keeps its shape.
//!
//! Bounds. With e = 2^-53: corners and edges in light space err by at most 8 e of their length in each coordinate, a cross
//! product of two by at most 64 e of the product of their lengths, D by at most 128 e of the product of three. Lengths are sums of
//! absolute coordinates, which only widens this. Stored u, v and q are computed in f64 and rounded once: they err by 2^-24 of
//! themselves and, through the projection, by 8 e (1 + u^2 + v^2).

use crate::shared::light_frame::Face;
use crate::shared::predicate::{self, Corners};

/// 64 e.
const CROSS_ERROR: f64 = 7.2e-15;
/// 128 e.
const TRIPLE_ERROR: f64 = 1.45e-14;
/// Projection error of u and v in f64, 8 e with room.
const PROJECTION_ERROR: f64 = 1e-14;
/// Two f32 roundings, 2^-23, with room: a coordinate, and what f64 adds.
const STORED_ERROR: f64 = 1.3e-7;
/// Eight f32 roundings, 2^-21, with room: coefficient, coordinate, product, two sums, shifted constant.
const EVALUATED_ERROR: f64 = 6e-7;
/// |u| and |v| of view-samples that are projected; beyond it the light is seen within 1e-5 of a right angle to the face.
pub const WILD: f64 = 1e5;

/// World to light space of one face.
#[derive(Clone, Copy, Debug)]
pub struct LightSpace {
    origin: [f32; 3],
    axes: [[f64; 3]; 3],
    mirrored: bool,
}

/// A view-sample in light space: tangents u and v, and the reciprocal of its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Tangent along axis x.
    pub u: f32,
    /// Tangent along axis y.
    pub v: f32,
    /// One over the depth, per scene unit.
    pub q: f32,
}

/// A caster with planes in f64.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Corners in light space.
    pub corners: [[f64; 3]; 3],
    /// n_k.
    pub edges: [[f64; 3]; 3],
    /// Bound on the error of each coordinate of n_k.
    pub edge_error: [f64; 3],
    /// N.
    pub normal: [f64; 3],
    /// Bound on the error of each coordinate of N.
    pub normal_error: f64,
    /// D, above zero.
    pub distance: f64,
    /// Bound on the error of D.
    pub distance_error: f64,
}

/// What a caster can block on a face.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "lives on the stack for the length of one caster; a box would cost more")]
pub enum Reach {
    /// Nothing.
    Nothing,
    /// Its pyramid.
    Cone(Cone),
    /// Anything: the light sample lies in its plane and in its box, so only the exact predicate can tell.
    Anything,
}

/// The four functions in f32, shifted up by their bounds: a negative value is surely outside.
#[derive(Clone, Copy, Debug, Default)]
pub struct Planes {
    /// Coefficients of u.
    pub u: [f32; 4],
    /// Coefficients of v.
    pub v: [f32; 4],
    /// Constants.
    pub one: [f32; 4],
    /// Coefficient of q in the last, the supporting plane; not above zero.
    pub q: f32,
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Sum of absolute coordinates.
pub(crate) fn size(a: [f64; 3]) -> f64 {
    a[0].abs() + a[1].abs() + a[2].abs()
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    [f64::from(a[0]) - f64::from(b[0]), f64::from(a[1]) - f64::from(b[1]), f64::from(a[2]) - f64::from(b[2])]
}

impl LightSpace {
    /// That of `face`.
    pub fn new(face: &Face) -> Self {
        let axes = [face.axis_x, face.axis_y, face.axis_z].map(|axis| axis.to_array().map(f64::from));
        Self { origin: face.origin.to_array(), axes, mirrored: dot(cross(axes[0], axes[1]), axes[2]) < 0.0 }
    }

    /// A world offset in light space.
    #[inline(always)]
    pub fn turn(&self, offset: [f64; 3]) -> [f64; 3] {
        [dot(self.axes[0], offset), dot(self.axes[1], offset), dot(self.axes[2], offset)]
    }

    /// Where the view-sample at `position` is, and whether that can be relied on: not when it is wild, which is too near the
    /// light, too far, or beside its view.
    #[inline(always)]
    pub fn project(&self, position: [f32; 3]) -> (Spot, bool) {
        let [x, y, z] = self.turn(minus(position, self.origin));
        let q = 1.0 / z;
        let (u, v) = (x * q, y * q);
        // The depth is lost to rounding where it is tiny against the offset, which the bound on u and v excludes.
        let tame = (q > 1e-30) & (q < 1e30) & (u.abs() < WILD) & (v.abs() < WILD);
        (Spot { u: u as f32, v: v as f32, q: q as f32 }, tame)
    }

    /// Corners of `caster` in light space.
    #[inline(always)]
    pub fn corners(&self, caster: &Corners) -> [[f64; 3]; 3] {
        let [a, b, c] = *caster;
        [a, b, c].map(|corner| self.turn(minus(corner, self.origin)))
    }

    /// What `caster` can block on this face.
    #[inline(always)]
    pub fn reach(&self, caster: &Corners) -> Reach {
        self.reach_of(caster, self.corners(caster))
    }

    /// What `caster` can block on this face; `corners` are its corners in light space.
    #[inline(always)]
    pub fn reach_of(&self, caster: &Corners, corners: [[f64; 3]; 3]) -> Reach {
        let [a, b, c] = *caster;
        let sizes = corners.map(size);
        let far = sizes[0].max(sizes[1]).max(sizes[2]);
        // View-samples that are not wild lie in front of the face's own plane by more than 7e-6 of their distance.
        if corners.iter().all(|corner| corner[2] < -1e-12 * far) {
            return Reach::Nothing;
        }
        let lines = [minus(b, a), minus(c, b), minus(a, c)].map(|edge| self.turn(edge));
        let lengths = lines.map(size);
        let normal = cross(lines[2], lines[0]);
        let distance = dot(corners[0], normal);
        let distance_error = TRIPLE_ERROR * sizes[0] * lengths[0] * lengths[2];
        let mut front = distance > 0.0;
        if distance.abs() <= distance_error {
            match predicate::side(caster, self.origin) {
                0 if self.in_box(caster) => return Reach::Anything,
                0 => return Reach::Nothing,
                side => front = (side > 0) != self.mirrored,
            }
        }
        let turned = if front { 1.0 } else { -1.0 };
        let mut cone = Cone {
            corners,
            edges: [[0.0; 3]; 3],
            edge_error: [0.0; 3],
            normal: normal.map(|x| turned * x),
            normal_error: CROSS_ERROR * lengths[0] * lengths[2],
            distance: (turned * distance).max(0.0),
            distance_error,
        };
        for k in 0..3 {
            cone.edges[k] = cross(corners[k], lines[k]).map(|x| turned * x);
            cone.edge_error[k] = CROSS_ERROR * sizes[k] * lengths[k];
        }
        Reach::Cone(cone)
    }

    /// Whether the light sample is in the closed box of `caster`, as it is when in the closed triangle.
    fn in_box(&self, caster: &Corners) -> bool {
        (0..3).all(|axis| {
            let along = caster.map(|corner| corner[axis]);
            let at = self.origin[axis];
            along.iter().any(|x| *x <= at) && along.iter().any(|x| *x >= at)
        })
    }
}

impl Planes {
    /// Planes that put nothing outside.
    pub const ANYTHING: Self = Self { u: [0.0; 4], v: [0.0; 4], one: [1.0; 4], q: 0.0 };

    /// Planes that put everything outside.
    pub const NOTHING: Self = Self { u: [0.0; 4], v: [0.0; 4], one: [-1.0; 4], q: 0.0 };

    /// Those of `reach`, for view-samples with |u| and |v| up to `extent`.
    pub fn of(reach: &Reach, extent: [f64; 2]) -> Self {
        match reach {
            Reach::Nothing => Self::NOTHING,
            Reach::Cone(cone) => Self::new(cone, extent),
            Reach::Anything => Self::ANYTHING,
        }
    }

    /// Those of `cone`, for view-samples with |u| and |v| up to `extent`.
    #[inline(always)]
    pub fn new(cone: &Cone, extent: [f64; 2]) -> Self {
        let mut planes = Self::ANYTHING;
        for k in 0..3 {
            planes.set(k, cone.edges[k], cone.edge_error[k], extent);
        }
        let scale = planes.set(3, cone.normal, cone.normal_error, extent);
        let q = -scale * (cone.distance * (1.0 - EVALUATED_ERROR) - cone.distance_error).max(0.0);
        if q > -1e30 {
            planes.q = q as f32;
        } else {
            planes = Self { q: 0.0, ..planes };
            (planes.u[3], planes.v[3], planes.one[3]) = (0.0, 0.0, 1.0);
        }
        planes
    }

    /// Function `k` from a plane's normal, scaled to a largest coefficient of 1; the scale.
    #[inline(always)]
    fn set(&mut self, k: usize, normal: [f64; 3], error: f64, extent: [f64; 2]) -> f64 {
        let largest = normal[0].abs().max(normal[1].abs()).max(normal[2].abs());
        if largest <= 1e-290 {
            // Left as it is: the edge points at the light, or has no length.
            return 0.0;
        }
        let scale = 1.0 / largest;
        let [x, y, z] = normal.map(|n| n * scale);
        let reach = x.abs() * extent[0] + y.abs() * extent[1] + z.abs();
        let projected =
            (error * scale + 3.0 * PROJECTION_ERROR) * (1.0 + extent[0] * extent[0] + extent[1] * extent[1]);
        self.u[k] = x as f32;
        self.v[k] = y as f32;
        self.one[k] = (z + EVALUATED_ERROR * reach + projected) as f32;
        scale
    }

    /// Whether `spot` is not surely outside: the scalar twin of the kernel in [`crate::shared::receivers`].
    pub fn may_cover(&self, spot: &Spot) -> bool {
        let value = |k: usize| self.u[k] * spot.u + self.v[k] * spot.v + self.one[k];
        value(0) >= 0.0 && value(1) >= 0.0 && value(2) >= 0.0 && value(3) + self.q * spot.q >= 0.0
    }
}

impl Cone {
    /// Whether the caster covers `spot`, where rounding leaves that beyond doubt.
    pub fn covers(&self, spot: &Spot) -> Option<bool> {
        let [u, v, q] = [spot.u, spot.v, spot.q].map(f64::from);
        let spread = 1.0 + u * u + v * v;
        let mut sure = true;
        for k in 0..4 {
            let (n, error, depth, depth_error) = if k < 3 {
                (self.edges[k], self.edge_error[k], 0.0, 0.0)
            } else {
                (self.normal, self.normal_error, self.distance * q, self.distance_error * q)
            };
            let value = n[0] * u + n[1] * v + n[2] - depth;
            let bound = STORED_ERROR * ((n[0] * u).abs() + (n[1] * v).abs() + depth)
                + (2.0 * error + PROJECTION_ERROR * size(n)) * spread
                + 2.0 * depth_error;
            if value < -bound {
                return Some(false);
            }
            sure &= value > bound;
        }
        sure.then_some(true)
    }

    /// Smallest and largest depth of the corners, scene units; zero or less behind the face.
    pub fn depths(&self) -> [f64; 2] {
        let [a, b, c] = self.corners.map(|corner| corner[2]);
        [a.min(b).min(c), a.max(b).max(c)]
    }
}

#[cfg(test)]
#[path = "pyramid_tests.rs"]
mod tests;
