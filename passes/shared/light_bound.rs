//! A convex body around all light samples, made of them alone: what the influence region of a caster is measured against
//! (Sintorn 2008, section 4.1).
//!
//! Offsets are taken from the origin of the light frame, which the body holds too: it is the mean of the light samples but for
//! rounding. Their principal axes A and half extents h along them give
//!
//! - a **solid**: the ball around the middle, or the ellipsoid { c + A diag(k h) y : |y| <= 1 } with the smallest k that holds
//!   all of them. Space is scaled so that the ellipsoid becomes a ball, as in the paper;
//! - a **flat** polygon, where the smallest half extent is at most [`FLAT`] of the largest: the polygon of k sides around the
//!   light samples whose directions are equally spaced after scaling by h. `thickness` is how far they stray from its plane.
//!   A single light sample is a polygon without extent.

use super::hull::MOST_SIDES;
use super::pyramid::{LightSpace, cross, dot, size};

/// Light samples whose least extent is at most this share of their largest count as planar.
pub const FLAT: f64 = 1e-3;
/// Bounds are widened by this share of themselves: above the rounding of their making.
const ROOM: f64 = 1e-9;

/// A vector.
pub type Vector = [f64; 3];

/// Which solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A ball.
    Sphere,
    /// An ellipsoid.
    Ellipsoid,
}

/// A body, in world offsets or in light space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// { centre + sum of y_k axes_k : |y| <= 1 }.
    Solid {
        /// Middle.
        centre: Vector,
        /// Half axes.
        axes: [Vector; 3],
    },
    /// A convex polygon, corners in order.
    Flat {
        /// Middle.
        centre: Vector,
        /// Corners, `sides` of them.
        corners: [Vector; MOST_SIDES],
        /// Number of corners.
        sides: usize,
        /// Light samples are within this of the polygon.
        thickness: f64,
    },
}

/// a + t b.
pub fn along(a: Vector, t: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + t * b[k])
}

/// a - b.
pub fn minus(a: Vector, b: Vector) -> Vector {
    along(a, -1.0, b)
}

/// Length.
pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

impl Body {
    /// Around `samples` and `origin`, as world offsets from `origin`; a flat one gets `sides` corners.
    pub fn around(samples: &[[f32; 3]], origin: [f32; 3], shape: Shape, sides: usize) -> Self {
        let offset = |sample: &[f32; 3]| [0, 1, 2].map(|k| f64::from(sample[k]) - f64::from(origin[k]));
        let offsets: Vec<Vector> = samples.iter().map(offset).chain([[0.0; 3]]).collect();
        let axes = principal_axes(&offsets);
        let along_axes: Vec<Vector> = offsets.iter().map(|offset| axes.map(|axis| dot(axis, *offset))).collect();
        let ends = |k: usize| {
            let ends = along_axes.iter().map(|at| at[k]);
            [ends.clone().fold(f64::MAX, f64::min), ends.fold(f64::MIN, f64::max)]
        };
        let (mut middle, mut half) = ([0.0; 3], [0.0; 3]);
        for k in 0..3 {
            let [low, high] = ends(k);
            (middle[k], half[k]) = (0.5 * (low + high), 0.5 * (high - low));
        }
        let centre = (0..3).fold([0.0; 3], |sum, k| along(sum, middle[k], axes[k]));
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| half[*b].total_cmp(&half[*a]));
        let [first, second, third] = order;
        let largest = half[first];
        if half[third] <= FLAT * largest {
            let pair = [first, second];
            let unit = pair.map(|k| if half[k] > 0.0 { half[k] } else { 1.0 });
            let flat: Vec<[f64; 2]> = along_axes
                .iter()
                .map(|at| [(at[first] - middle[first]) / unit[0], (at[second] - middle[second]) / unit[1]])
                .collect();
            let mut corners = [centre; MOST_SIDES];
            for (corner, [x, y]) in corners.iter_mut().zip(polygon_around(&flat, sides)) {
                *corner = along(along(centre, x * unit[0], axes[first]), y * unit[1], axes[second]);
            }
            return Self::Flat { centre, corners, sides, thickness: half[third] * (1.0 + ROOM) + ROOM * largest };
        }
        let scale = match shape {
            Shape::Sphere => [1.0; 3],
            Shape::Ellipsoid => half,
        };
        let reach = |at: &Vector| length([0, 1, 2].map(|k| (at[k] - middle[k]) / scale[k]));
        let reach = along_axes.iter().map(reach).fold(0.0, f64::max) * (1.0 + ROOM);
        Self::Solid { centre, axes: [0, 1, 2].map(|k| axes[k].map(|x| x * scale[k] * reach)) }
    }

    /// The same body in the light space of a face.
    pub fn turned(&self, space: &LightSpace) -> Self {
        match *self {
            Self::Solid { centre, axes } => {
                Self::Solid { centre: space.turn(centre), axes: axes.map(|axis| space.turn(axis)) }
            }
            Self::Flat { centre, corners, sides, thickness } => Self::Flat {
                centre: space.turn(centre),
                corners: corners.map(|corner| space.turn(corner)),
                sides,
                // Axes are orthonormal to f32 rounding.
                thickness: thickness * (1.0 + 1e-6),
            },
        }
    }

    /// Middle.
    pub fn centre(&self) -> Vector {
        match *self {
            Self::Solid { centre, .. } | Self::Flat { centre, .. } => centre,
        }
    }

    /// The largest `normal` . x over the body.
    pub fn most(&self, normal: Vector) -> f64 {
        match self {
            Self::Solid { centre, axes } => dot(normal, *centre) + length(axes.map(|axis| dot(normal, axis))),
            Self::Flat { corners, sides, thickness, .. } => {
                corners[..*sides].iter().map(|corner| dot(normal, *corner)).fold(f64::MIN, f64::max)
                    + thickness * length(normal)
            }
        }
    }

    /// Largest sum of absolute coordinates in it, at most.
    pub fn reach(&self) -> f64 {
        match self {
            Self::Solid { centre, axes } => size(*centre) + axes.iter().map(|axis| size(*axis)).sum::<f64>(),
            Self::Flat { corners, sides, thickness, .. } => {
                corners[..*sides].iter().map(|corner| size(*corner)).fold(0.0, f64::max) + 2.0 * thickness
            }
        }
    }
}

/// The polygon of `sides` sides, in equally spaced directions, around points of the plane.
fn polygon_around(points: &[[f64; 2]], sides: usize) -> Vec<[f64; 2]> {
    let direction = |k: usize| {
        let angle = k as f64 * std::f64::consts::TAU / sides as f64;
        [angle.cos(), angle.sin()]
    };
    let most = |k: usize| {
        let [x, y] = direction(k);
        let reached = |point: &[f64; 2]| x * point[0] + y * point[1] + ROOM * (point[0].abs() + point[1].abs());
        points.iter().map(reached).fold(f64::MIN, f64::max)
    };
    let sin = (std::f64::consts::TAU / sides as f64).sin();
    (0..sides)
        .map(|k| {
            let next = (k + 1) % sides;
            let (a, b, at_a, at_b) = (direction(k), direction(next), most(k), most(next));
            [(at_a * b[1] - at_b * a[1]) / sin, (at_b * a[0] - at_a * b[0]) / sin]
        })
        .collect()
}

/// Orthonormal axes along which the spread of `offsets` is uncorrelated, by Jacobi's rotations; any axes will do for a bound, so a few
/// rounds are enough.
fn principal_axes(offsets: &[Vector]) -> [Vector; 3] {
    let largest = offsets.iter().flatten().fold(0.0f64, |largest, x| largest.max(x.abs()));
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    if !(largest > 0.0 && largest < f64::MAX) {
        return axes;
    }
    let mean = [0, 1, 2].map(|k| offsets.iter().map(|offset| offset[k] / largest).sum::<f64>() / offsets.len() as f64);
    let mut spread = [[0.0; 3]; 3];
    for offset in offsets {
        let at = [0, 1, 2].map(|k| offset[k] / largest - mean[k]);
        for (row, x) in spread.iter_mut().zip(at) {
            *row = along(*row, x, at);
        }
    }
    for _ in 0..6 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if spread[p][q].abs() <= 1e-14 * (spread[p][p] + spread[q][q]) {
                continue;
            }
            let cot = (spread[q][q] - spread[p][p]) / (2.0 * spread[p][q]);
            let tan = cot.signum() / (cot.abs() + (cot * cot + 1.0).sqrt());
            let cos = 1.0 / (tan * tan + 1.0).sqrt();
            let sin = tan * cos;
            // Rows and columns of the spread, and the axes, turn together.
            for row in &mut spread {
                (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
            }
            let (row_p, row_q) = (spread[p], spread[q]);
            for k in 0..3 {
                spread[p][k] = cos * row_p[k] - sin * row_q[k];
                spread[q][k] = sin * row_p[k] + cos * row_q[k];
            }
            let (a, b) = (axes[p], axes[q]);
            axes[p] = [0, 1, 2].map(|k| cos * a[k] - sin * b[k]);
            axes[q] = [0, 1, 2].map(|k| sin * a[k] + cos * b[k]);
        }
    }
    axes
}

/// Rows of the inverse of the matrix with columns `axes`; none where it has no inverse to speak of.
pub fn inverse_rows(axes: &[Vector; 3]) -> Option<[Vector; 3]> {
    let [a, b, c] = *axes;
    let determinant = dot(a, cross(b, c));
    let rows = [cross(b, c), cross(c, a), cross(a, b)].map(|row| row.map(|x| x / determinant));
    rows.iter().flatten().all(|x| x.is_finite()).then_some(rows)
}

#[cfg(test)]
#[path = "light_bound_tests.rs"]
mod tests;
