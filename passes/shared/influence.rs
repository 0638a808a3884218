//! The influence region of a caster on a face: the texels from whose view-samples it may hide some light sample (Sintorn 2008,
//! section 4.1), as rows, a span of columns in each, and a test of single cells. Light space, f64.
//!
//! With B a convex body around the light samples and the origin ([`crate::shared::light_bound`]), a view-sample P that the caster t
//! hides from s in B is P = x + r (x - s) with x in t and r >= 0. Two kinds of bounds follow.
//!
//! **The hull.** P moved away from the origin to depth D is hidden from a point of B too, so for all P up to depth D the projections
//! of t from B onto the plane at depth D are enough, and they lie in the hull of the projections of B through the three corners.
//! As seen from a corner v a ball of radius R at distance d lies in a cone of half angle asin(R / d); the regular polygon of
//! k sides around its circle gives k directions, with the polygon of a flat body they are v - q. Each meets the plane, or
//! there is no hull: v is then nearer than the extent of the light, or beside the face.
//!
//! **Separating planes.** For any n with h = max over B of n . s, and m = min over t of n . x, not below h: n . P >= m. In image
//! coordinates n . (u, v, 1) >= m q with q = 1 / depth, sharpest at the largest depth of a cell. n is the normal of the caster's own
//! plane, which cuts off the light's side (Lehtinen, Laine, Aila 2006), and the planes through each edge that touch B. Rounding
//! may leave m below h by g; with d the distance of t and B, 1 + r <= (|P| + |s|) / d, and n . P >= h - (1 + r) g. So no
//! direction n is wrong, only less sharp.
//!
//! Where t touches B there are neither, and the region is the whole face. Slack for the rounding of view-samples is that of
//! [`crate::shared::footprint`].

use super::face_light::{Bounds, ERROR, FaceLight, Line};
use super::footprint::{Grid, SLACK};
use super::hull::{HULL_ROOM, MOST_POINTS, hull_of_three};
use super::light_bound::{Body, Shape, Vector, minus};
use super::pair_walk::{Region, Side};
use super::pyramid::{cross, dot, size};

/// Planes: the caster's own, and two through each edge.
const MOST_PLANES: usize = 7;

/// The region.
#[derive(Clone, Copy, Debug)]
pub struct Influence {
    rows: [usize; 2],
    columns: [usize; 2],
    /// Separating planes.
    planes: [Line; MOST_PLANES],
    plane_count: usize,
    /// Sides of the hull.
    sides: [Line; MOST_POINTS],
    side_count: usize,
    /// Nearest depth of the caster; no depth where the light reaches deeper.
    near: f64,
    /// One over the largest depth of a view-sample.
    least_q: f64,
    /// Whether nothing bounds it.
    pub is_whole: bool,
}

/// The light as each of `sides` sees it.
pub fn face_lights(sides: &[Side], samples: &[[f32; 3]], shape: Shape, bounds: Bounds) -> Vec<FaceLight> {
    // Faces share their origin.
    let origin = sides.first().map_or([0.0; 3], |side| side.face.origin.to_array());
    let body = Body::around(samples, origin, shape, bounds.sides);
    sides.iter().map(|side| FaceLight::new(body.turned(&side.space), bounds)).collect()
}

impl FaceLight {
    /// The region of the caster with these corners in light space; none when it can matter to no view-sample of the face.
    pub fn region(&self, corners: &[Vector; 3], grid: &Grid) -> Option<Influence> {
        if self.is_beside(corners, grid) {
            return None;
        }
        let ends = |pick: fn(f64, f64) -> f64| corners.iter().map(|corner| corner[2]).reduce(pick).unwrap_or(0.0);
        let (near, deepest) = (ends(f64::min), ends(f64::max));
        let far = corners.iter().map(|corner| size(*corner)).fold(self.reach, f64::max);
        let near = if near > self.deepest + ERROR * far { near } else { f64::MIN };
        if near > grid.far {
            return None;
        }
        let mut region = Influence {
            rows: [0, grid.side - 1],
            columns: [0, grid.side - 1],
            planes: [Line::default(); MOST_PLANES],
            plane_count: 0,
            sides: [Line::default(); MOST_POINTS],
            side_count: 0,
            near,
            least_q: 1.0 / grid.far,
            is_whole: false,
        };
        let has_hull = region.set_hull(self, corners, grid, grid.far.max(deepest))?;
        region.set_planes(self, corners);
        region.is_whole = !has_hull && region.plane_count == 0;
        Some(region)
    }
}

impl Influence {
    /// Sets the planes.
    fn set_planes(&mut self, light: &FaceLight, corners: &[Vector; 3]) {
        let [a, b, c] = *corners;
        let normal = cross(minus(b, a), minus(c, a));
        let gap = light.gap(corners, normal);
        if gap <= 0.0 {
            return;
        }
        let front = if dot(normal, a) < 0.0 { normal.map(|x| -x) } else { normal };
        let own = light.bounds.cut.then_some(front);
        let edges = if light.bounds.is_quad { &[][..] } else { &[(a, b), (b, c), (c, a)][..] };
        let touching = edges.iter().flat_map(|(a, b)| light.edge_normals(*a, *b)).flatten();
        for line in own.into_iter().chain(touching).filter_map(|normal| light.plane(corners, normal, gap)) {
            self.planes[self.plane_count] = line;
            self.plane_count += 1;
        }
    }

    /// Sets the hull at `depth`: whether there is one; none when it is beside all view-samples.
    fn set_hull(&mut self, light: &FaceLight, corners: &[Vector; 3], grid: &Grid, depth: f64) -> Option<bool> {
        let Some((points, pad)) = light.projections(corners, depth) else {
            return Some(false);
        };
        let count = 3 * light.bounds.sides;
        let mut ends = [[f64::MAX, f64::MIN]; 2];
        for point in &points[..count] {
            for axis in 0..2 {
                ends[axis] = [ends[axis][0].min(point[axis] - pad), ends[axis][1].max(point[axis] + pad)];
            }
        }
        let [u, v] = ends.map(|[low, high]| low.abs().max(high.abs()));
        let slack = SLACK * (1.0 + u * u + v * v);
        self.columns = grid.range(0, [ends[0][0] - slack, ends[0][1] + slack])?;
        self.rows = grid.range(1, [ends[1][0] - slack, ends[1][1] + slack])?;
        let small = self.rows[1] - self.rows[0] < 2 || self.columns[1] - self.columns[0] < 2;
        if small || light.bounds.is_quad {
            return Some(true);
        }
        let mut hull = [[0.0; 2]; HULL_ROOM];
        let corner_count = hull_of_three(&points[..count], &mut hull);
        // More corners than points are doubles by rounding; without a side the region is only larger.
        for k in 0..corner_count.min(MOST_POINTS) {
            let (a, b) = (hull[k], hull[(k + 1) % corner_count]);
            let [x, y] = [a[1] - b[1], b[0] - a[0]];
            // Counter-clockwise: the inside is on the left. Measured against all points, so that no direction is wrong.
            let along = points[..count].iter().map(|point| x * point[0] + y * point[1]);
            let least = along.fold(f64::MAX, f64::min) - (x.abs() + y.abs()) * pad;
            let long = x.abs() + y.abs() + least.abs();
            if x.abs() + y.abs() > 1e-12 * long {
                let line = Line { u: x / long, v: y / long, one: -least / long, depth: 0.0, slack: SLACK };
                self.sides[self.side_count] = line;
                self.side_count += 1;
            }
        }
        Some(true)
    }
}

impl Region for Influence {
    fn rows(&self) -> [usize; 2] {
        self.rows
    }

    fn span(&self, grid: &Grid, row: usize) -> Option<[usize; 2]> {
        let v = grid.extent(1, row);
        let widest = grid.reach[0][0].abs().max(grid.reach[0][1].abs());
        let mut ends = [f64::MIN, f64::MAX];
        for line in self.planes[..self.plane_count].iter().chain(&self.sides[..self.side_count]) {
            let at = |v: f64| line.v * v + line.slack * v.abs();
            let rest = line.one - line.depth * self.least_q + line.slack + at(v[0]).max(at(v[1]));
            // A half-line, whose end is left or right of zero as `rest` says.
            let turned = if rest < 0.0 { line.slack } else { -line.slack };
            if line.u > 4.0 * line.slack {
                ends[0] = ends[0].max(-rest / (line.u + turned));
            } else if line.u < -4.0 * line.slack {
                ends[1] = ends[1].min(-rest / (line.u - turned));
            } else if rest + 5.0 * line.slack * widest < 0.0 {
                return None;
            }
        }
        if ends[0] > ends[1] {
            return None;
        }
        let [first, last] = grid.range(0, ends)?;
        let span = [first.max(self.columns[0]), last.min(self.columns[1])];
        (span[0] <= span[1]).then_some(span)
    }

    fn is_behind(&self, grid: &Grid, at: [usize; 2], list_far: f32) -> bool {
        if grid.is_behind(self.near, list_far, at) {
            return true;
        }
        let q = 1.0 / f64::from(list_far);
        // The span has seen to it where the cell is as deep as the face.
        if q < 1.02 * self.least_q {
            return false;
        }
        let [u, v] = [grid.extent(0, at[0]), grid.extent(1, at[1])];
        self.planes[..self.plane_count].iter().any(|line| {
            let along = |x: f64, at: f64| x * at + line.slack * at.abs();
            let across = along(line.u, u[0]).max(along(line.u, u[1])) + along(line.v, v[0]).max(along(line.v, v[1]));
            across + line.one + line.slack < line.depth * q
        })
    }
}
