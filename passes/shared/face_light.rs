//! The light as one face sees it: what it sends through a corner, how far it is from a caster, and which planes separate the two.
//! See [`crate::shared::influence`], which regions are made in.

use super::footprint::{Grid, SLACK};
use super::hull::{MOST_POINTS, MOST_SIDES, Point};
use super::light_bound::{Body, Vector, along, inverse_rows, length, minus};
use super::pyramid::{cross, dot, size};

/// A point of the body or of the caster in light space errs by this share of the sum of its sizes, and so does its product with a
/// normal of size one: forty roundings.
pub(super) const ERROR: f64 = 1e-14;
/// A direction of the hull is within this of its size of the plane beside the light: it says too little.
const BESIDE: f64 = 1e-3;
/// What rounding may have moved a hull point by, as a share of 1 + |u| + |v|.
const HULL_ERROR: f64 = 1e-7;
/// Slack beyond which a plane is left out.
const BLUNT: f64 = 1e-2;

/// What bounds regions besides the polygons' degree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Sides of the polygon around the light's silhouette.
    pub sides: usize,
    /// Only the box of the hull, no hull and no planes through edges.
    pub is_quad: bool,
    /// Whether the caster's own plane cuts.
    pub cut: bool,
}

/// The light as one face sees it.
#[derive(Clone, Copy, Debug)]
pub struct FaceLight {
    body: Body,
    pub(super) bounds: Bounds,
    /// Of a solid: rows of the map that takes it to the unit ball about the origin.
    to_ball: Option<[Vector; 3]>,
    /// Of a flat body: normal of its plane.
    flat_normal: Vector,
    /// Cosines and sines of the polygon's corners, widened so that its sides touch the unit circle.
    ring: [[f64; 2]; MOST_SIDES],
    /// Largest sum of absolute coordinates.
    pub(super) reach: f64,
    /// Largest depth.
    pub(super) deepest: f64,
}

/// a u + b v + one + slack (1 + |u| + |v|) >= depth / far inside.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    pub u: f64,
    pub v: f64,
    pub one: f64,
    pub depth: f64,
    pub slack: f64,
}

impl FaceLight {
    /// That of `body`, which is in the light space of the face.
    pub fn new(body: Body, bounds: Bounds) -> Self {
        let to_ball = match &body {
            Body::Solid { axes, .. } => inverse_rows(axes),
            Body::Flat { .. } => None,
        };
        let flat_normal = match &body {
            Body::Flat { corners, sides, .. } => {
                let across = |k: usize| minus(corners[k % sides], corners[0]);
                cross(across(1), across(sides / 2 + 1))
            }
            Body::Solid { .. } => [0.0; 3],
        };
        let step = std::f64::consts::TAU / bounds.sides as f64;
        let widened = 1.0 / (0.5 * step).cos();
        let mut ring = [[0.0; 2]; MOST_SIDES];
        for (k, corner) in ring.iter_mut().enumerate() {
            let (sin, cos) = (step * k as f64).sin_cos();
            *corner = [widened * cos, widened * sin];
        }
        let deepest = body.most([0.0, 0.0, 1.0]);
        Self { body, bounds, to_ball, flat_normal, ring, reach: body.reach(), deepest }
    }

    /// Whether no view-sample of the face can be hidden: the caster lies beyond one of its sides, and further beyond than the light.
    pub(super) fn is_beside(&self, corners: &[Vector; 3], grid: &Grid) -> bool {
        let far = corners.iter().map(|corner| size(*corner)).fold(self.reach, f64::max);
        let [[left, right], [top, bottom]] = grid.reach;
        // Each normal points inwards.
        let sides = [[1.0, 0.0, -left], [-1.0, 0.0, right], [0.0, 1.0, -top], [0.0, -1.0, bottom], [0.0, 0.0, 1.0]];
        sides.into_iter().any(|normal| {
            let slack = SLACK * size(normal) * far;
            let most = corners.iter().map(|corner| dot(normal, *corner)).fold(f64::MIN, f64::max);
            most < -slack && most < -self.body.most(normal.map(|x| -x)) - slack
        })
    }

    /// The directions in which the body's points send view-samples through `corner`; none where it touches the body.
    fn directions(&self, corner: Vector) -> Option<[Vector; MOST_SIDES]> {
        let mut directions = [[0.0; 3]; MOST_SIDES];
        match &self.body {
            Body::Flat { corners, .. } => {
                for (direction, from) in directions.iter_mut().zip(corners) {
                    *direction = minus(corner, *from);
                }
            }
            Body::Solid { centre, axes } => {
                let at = apply(self.to_ball.as_ref()?, minus(corner, *centre));
                let square = dot(at, at);
                if square < 1.0 + 1e-6 {
                    return None;
                }
                let axis = at.map(|x| x / square.sqrt());
                let tangent = 1.0 / (square - 1.0).sqrt();
                let [a, b] = across(axis);
                for (direction, [cos, sin]) in directions.iter_mut().zip(self.ring) {
                    let ray = along(along(axis, tangent * cos, a), tangent * sin, b);
                    *direction = (0..3).fold([0.0; 3], |sum, k| along(sum, ray[k], axes[k]));
                }
            }
        }
        Some(directions)
    }

    /// Where those of all corners meet the plane at `depth`, and how far off they may be; none where one does not.
    pub(super) fn projections(&self, corners: &[Vector; 3], depth: f64) -> Option<([Point; MOST_POINTS], f64)> {
        let sides = self.bounds.sides;
        let thickness = if let Body::Flat { thickness, .. } = self.body { thickness } else { 0.0 };
        let (mut points, mut pad) = ([[0.0; 2]; MOST_POINTS], 0.0f64);
        for (k, corner) in corners.iter().enumerate() {
            let directions = self.directions(*corner)?;
            for (j, direction) in directions[..sides].iter().enumerate() {
                let z = direction[2] - thickness;
                if z <= BESIDE * size(*direction) {
                    return None;
                }
                let beyond = (depth - corner[2]) / (depth * direction[2]);
                let at = [0, 1].map(|axis| corner[axis] / depth + direction[axis] * beyond);
                let (w, strayed) = (size(*direction) / z, thickness * (depth - corner[2]) / (depth * z));
                points[k * sides + j] = at;
                pad = pad.max(HULL_ERROR * (1.0 + at[0].abs() + at[1].abs()) + strayed * (1.0 + w));
            }
        }
        Some((points, pad))
    }

    /// Distance of the caster and the body, at most; not above zero where they may touch.
    pub(super) fn gap(&self, corners: &[Vector; 3], normal: Vector) -> f64 {
        let from = corners.map(|corner| minus(corner, self.body.centre()));
        let towards = match &self.to_ball {
            // The nearest point of the scaled caster, and its normal taken back.
            Some(rows) => {
                let nearest = nearest_to_origin(&from.map(|offset| apply(rows, offset)));
                (0..3).fold([0.0; 3], |sum, k| along(sum, nearest[k], rows[k]))
            }
            None => nearest_to_origin(&from),
        };
        // The caster's own plane and the light's, turned towards the caster, where they separate better.
        let front = |normal: Vector| if dot(normal, from[0]) < 0.0 { normal.map(|x| -x) } else { normal };
        let normals = [towards, front(normal), front(self.flat_normal)];
        let gap = |normal: Vector| {
            let long = length(normal);
            if long > 1e-290 { self.margin(corners, normal.map(|x| x / long))[2] } else { f64::MIN }
        };
        normals.into_iter().map(gap).fold(f64::MIN, f64::max)
    }

    /// Smallest n . x over the caster, largest n . s over the body, both on the safe side, and how far the first is above.
    fn margin(&self, corners: &[Vector; 3], normal: Vector) -> [f64; 3] {
        let (mut least, mut far) = (f64::MAX, self.reach);
        for corner in corners {
            least = least.min(dot(normal, *corner));
            far = far.max(size(*corner));
        }
        let room = ERROR * far * size(normal);
        let most = (self.body.most(normal) + room).max(0.0);
        [least - room, most, least - room - most]
    }

    /// The plane of `normal`; none where it bounds nothing.
    pub(super) fn plane(&self, corners: &[Vector; 3], normal: Vector, gap: f64) -> Option<Line> {
        let long = size(normal);
        if !(long > 1e-290 && long < f64::MAX) {
            return None;
        }
        let n = normal.map(|x| x / long);
        let [least, most, margin] = self.margin(corners, n);
        let blunt = (-margin).max(0.0) / gap;
        let depth = if margin < 0.0 { most - self.reach * blunt } else { least };
        let sharp = blunt < BLUNT && depth >= 0.0;
        sharp.then_some(Line { u: n[0], v: n[1], one: n[2], depth, slack: SLACK + blunt })
    }

    /// Normals of the planes through the edge from `a` to `b` that touch the body.
    pub(super) fn edge_normals(&self, a: Vector, b: Vector) -> Option<[Vector; 2]> {
        let edge = minus(b, a);
        match &self.body {
            Body::Solid { centre, .. } => {
                let rows = self.to_ball.as_ref()?;
                let (from, edge) = (apply(rows, minus(a, *centre)), apply(rows, edge));
                let square = dot(edge, edge);
                let foot = along(from, -dot(from, edge) / square, edge);
                let (away, aside) = (length(foot), cross(edge, foot));
                if !(square > 1e-290 && away > 1.0) {
                    return None;
                }
                let (cos, sin) = (1.0 / away, (1.0 - 1.0 / (away * away)).sqrt());
                let unit = foot.map(|x| x / away);
                let aside = aside.map(|x| x / (square.sqrt() * away));
                let back = |n: Vector| (0..3).fold([0.0; 3], |sum, k| along(sum, n[k], rows[k]));
                let part = unit.map(|x| cos * x);
                Some([back(along(part, sin, aside)), back(along(part, -sin, aside))])
            }
            Body::Flat { corners, sides, .. } => {
                let long = length(edge);
                if long <= 1e-290 {
                    return None;
                }
                let [x, y] = across(edge.map(|x| x / long));
                // Around the edge the corners are directions of the plane; the outermost ones touch.
                let at = |corner: &Vector| [dot(x, minus(*corner, a)), dot(y, minus(*corner, a))];
                let turn = |p: Point, q: Point| p[0] * q[1] - p[1] * q[0];
                let (mut left, mut right) = (at(&corners[0]), at(&corners[0]));
                for corner in &corners[1..*sides] {
                    let here = at(corner);
                    left = if turn(left, here) > 0.0 { here } else { left };
                    right = if turn(right, here) < 0.0 { here } else { right };
                }
                let normal = |p: Point| along(x.map(|x| -p[1] * x), p[0], y);
                Some([normal(left), normal([-right[0], -right[1]])])
            }
        }
    }
}

/// Rows times a vector.
fn apply(rows: &[Vector; 3], v: Vector) -> Vector {
    rows.map(|row| dot(row, v))
}

/// Two unit vectors across a unit vector and each other.
fn across(axis: Vector) -> [Vector; 2] {
    let least = (0..3).fold(0, |least, k| if axis[k].abs() < axis[least].abs() { k } else { least });
    let mut unit = [0.0; 3];
    unit[least] = 1.0;
    let a = cross(axis, unit);
    let long = length(a);
    let a = a.map(|x| x / long);
    [a, cross(axis, a)]
}

/// The point of a triangle nearest to the origin, but for rounding.
fn nearest_to_origin(corners: &[Vector; 3]) -> Vector {
    let [a, b, c] = *corners;
    let normal = cross(minus(b, a), minus(c, a));
    let square = dot(normal, normal);
    let inside = [(a, b), (b, c), (c, a)].iter().all(|(p, q)| dot(cross(*p, *q), normal) >= 0.0);
    if square > 1e-290 && inside {
        let t = dot(normal, a) / square;
        return normal.map(|x| t * x);
    }
    let on_edge = |(p, q): (Vector, Vector)| {
        let edge = minus(q, p);
        let square = dot(edge, edge);
        let t = if square > 0.0 { (-dot(p, edge) / square).clamp(0.0, 1.0) } else { 0.0 };
        along(p, t, edge)
    };
    let mut nearest = on_edge((a, b));
    for edge in [(b, c), (c, a)] {
        let point = on_edge(edge);
        if dot(point, point) < dot(nearest, nearest) {
            nearest = point;
        }
    }
    nearest
}
