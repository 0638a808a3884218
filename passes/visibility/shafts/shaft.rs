//! A shaft: all segments from a group of view-samples to a group of light samples, and what sixteen casters do to it at once.
//!
//! For an edge from a along e, f(v, s) = det(a - v, e, s - v) says on which side of the edge the segment from v to s passes. It is
//! affine in v and in s. With c and l the middles of both groups, A = a - c, L = l - c and m = A x e, its value in the middle is
//! L . m, its change with s is (s - l) . m, with v it is (v - c) . (L x e - m), and the product of both changes it by
//! e . ((v - c) x (s - l)). Over a slanted box and a plain one that gives f its bounds.
//!
//! A caster with normal N blocks a segment from below (N . (v - a) < 0) when all three f >= 0 and N . (s - a) >= 0, and from above with
//! all signs turned: the conditions of [`crate::shared::predicate`].
//!
//! Bounds, u = 2^-24. A coordinate in the cluster's space is one difference and three products: a point x away from the frame's origin errs
//! by at most 7 u |x|, a sum of two such by 8 u. Let E bound the edges of a triangle, R its corners and the view-samples, D the light
//! samples and the view-samples, as lengths. The third edge, a difference, errs by 15 u E. Through its arguments f errs by less than
//! (8 + 15 + 7) u E R D, through its evaluation at one segment by 11 u E R D; the bounds over a shaft are sums of at most eight parts,
//! none above E R D, of five roundings each. In all that is less than 72 u E R D, and for one segment less than 45 u. N . (x - a) likewise errs by less than 48 u |g| |h| (R + D).

use super::LANES;
use super::candidates::Candidates;
use super::groups::{LightBox, Slanted};
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16, mask32x16};

/// Bound on the error of f, as a share of E R D.
pub const EDGE_ERROR: f32 = 72.0 * 5.960_464_5e-8;
/// The same for one segment, as a share of that for a shaft.
pub const SEGMENT_SHARE: f32 = 45.0 / 72.0;
/// Bound on the error of N . (x - a), as a share of |g| |h| (R + D).
pub const PLANE_ERROR: f32 = 48.0 * 5.960_464_5e-8;
/// Bound on the error of a corner, and of its place beside a plane of the shaft, as a share of R.
pub const CORNER_ERROR: f32 = 16.0 * 5.960_464_5e-8;
/// What products of tiny numbers may lose.
pub const TINY: f32 = 1e-36;

/// A plane along the shaft: beyond it is `x[axis] - slope z > limit`, or `<` for the other side.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// k.
    pub slope: f32,
    /// Where it begins.
    pub limit: f32,
}

/// The shaft.
#[derive(Clone, Copy, Debug)]
pub struct Shaft {
    views: Slanted,
    /// From the middle of the view-samples to that of the light samples.
    along: [f32; 3],
    light_half: [f32; 3],
    /// Bounds on the coordinates of (v - c) x (s - l).
    cross: [f32; 3],
    /// Upper sides of x and y.
    pub upper: [Side; 2],
    /// Lower sides of x and y.
    pub lower: [Side; 2],
    /// Smallest and largest z.
    pub depth: [f32; 2],
}

/// What sixteen casters do to a shaft, a bit each.
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    /// May block some segment and may leave some free.
    pub open: u16,
    /// Blocks every segment.
    pub covers: u16,
    /// Each edge: may be crossed by some segment.
    pub edge: [u16; 3],
    /// All view-samples are below for certain, and all light samples above.
    pub from_below: u16,
    /// The other way about.
    pub from_above: u16,
    /// Bounds are wider through the view-samples than through the light samples.
    pub views_wider: u16,
}

/// Three coordinates of sixteen points. What is done to them is written out: a closure that `array::map` calls would leave the
/// instruction set that its caller was compiled for.
pub type Vector<S> = [f32x16<S>; 3];

/// a + b.
#[inline(always)]
pub fn plus<S: Simd>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a - b.
#[inline(always)]
pub fn minus<S: Simd>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a - b for one point b.
#[inline(always)]
pub fn from<S: Simd>(a: Vector<S>, b: [f32; 3]) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Absolute coordinates.
#[inline(always)]
pub fn abs<S: Simd>(a: Vector<S>) -> Vector<S> {
    [a[0].abs(), a[1].abs(), a[2].abs()]
}

/// a x b.
#[inline(always)]
pub fn cross<S: Simd>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}

/// a x b - c for one vector a.
#[inline(always)]
fn cross_minus<S: Simd>(a: [f32; 3], b: Vector<S>, c: Vector<S>) -> Vector<S> {
    let less = [b[2].mul_sub(a[1], c[0]), b[0].mul_sub(a[2], c[1]), b[1].mul_sub(a[0], c[2])];
    [b[1].mul_add(-a[2], less[0]), b[2].mul_add(-a[0], less[1]), b[0].mul_add(-a[1], less[2])]
}

/// a . b for one vector a.
#[inline(always)]
pub fn dot_one<S: Simd>(a: [f32; 3], b: Vector<S>) -> f32x16<S> {
    b[0].mul_add(a[0], b[1].mul_add(a[1], b[2] * a[2]))
}

/// a . b.
#[inline(always)]
pub fn dot<S: Simd>(a: Vector<S>, b: Vector<S>) -> f32x16<S> {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// Coordinates at `place..place + 16`.
#[inline(always)]
pub fn load<S: Simd>(simd: S, along: &[f32], place: usize) -> f32x16<S> {
    f32x16::from_slice(simd, &along[place..place + LANES])
}

/// Where a point is across a side of this slope.
#[inline(always)]
fn beyond<S: Simd>(p: Vector<S>, axis: usize, slope: f32) -> f32x16<S> {
    p[2].mul_add(-slope, p[axis])
}

#[inline(always)]
fn bits<S: Simd>(mask: mask32x16<S>) -> u16 {
    mask.to_bitmask() as u16
}

impl Shaft {
    /// Between `views` and `light`.
    pub fn new(views: Slanted, light: LightBox) -> Self {
        let middle = [0, 1, 2].map(|k| 0.5 * (light.low[k] + light.high[k]));
        let light_half = [0, 1, 2].map(|k| (0.5 * (light.high[k] - light.low[k])) * (1.0 + 1e-6));
        let [x, y] = views.half;
        let along_z = views.slope[0].abs() * x + views.slope[1].abs() * y + views.rest;
        let [ux, uy, uz] = light_half;
        let [upper_x, upper_y, lower_x, lower_y] = sides(&views, &light);
        Self {
            along: [0, 1, 2].map(|k| middle[k] - views.centre[k]),
            light_half,
            cross: [along_z * uy + y * uz, along_z * ux + x * uz, x * uy + y * ux],
            upper: [upper_x, upper_y],
            lower: [lower_x, lower_y],
            depth: [views.low[2].min(light.low[2]), views.high[2].max(light.high[2])],
            views,
        }
    }

    /// How far coordinates of `normal . (v - c)` can be from its middle.
    #[inline(always)]
    fn views_spread<S: Simd>(&self, normal: Vector<S>) -> f32x16<S> {
        let [p, q] = self.views.slope;
        let x = normal[2].mul_add(p, normal[0]).abs();
        let y = normal[2].mul_add(q, normal[1]).abs();
        x.mul_add(self.views.half[0], y.mul_add(self.views.half[1], normal[2].abs() * self.views.rest))
    }

    #[inline(always)]
    fn light_spread<S: Simd>(&self, normal: Vector<S>) -> f32x16<S> {
        dot_one(self.light_half, abs(normal))
    }

    /// Casters at `place..place + 16` that are not wholly beside the shaft.
    #[inline(always)]
    fn beside<S: Simd>(&self, corners: [Vector<S>; 3], far: f32x16<S>) -> u16 {
        let [a, b, c] = corners;
        let (low, high) = (a[2].min(b[2]).min(c[2]), a[2].max(b[2]).max(c[2]));
        let mut beside = bits((low - far).simd_gt(self.depth[1])) | bits((high + far).simd_lt(self.depth[0]));
        for axis in 0..2 {
            let Side { slope, limit } = self.upper[axis];
            let nearest = beyond(a, axis, slope).min(beyond(b, axis, slope)).min(beyond(c, axis, slope));
            beside |= bits(far.mul_add(-1.0 - slope.abs(), nearest).simd_gt(limit));
            let Side { slope, limit } = self.lower[axis];
            let nearest = beyond(a, axis, slope).max(beyond(b, axis, slope)).max(beyond(c, axis, slope));
            beside |= bits(far.mul_add(1.0 + slope.abs(), nearest).simd_lt(limit));
        }
        beside
    }

    /// What the casters at `place..place + 16` do; lanes of `lanes` only.
    #[inline(always)]
    pub fn meet<S: Simd>(&self, simd: S, list: &Candidates, place: usize, lanes: u16) -> Answer {
        let rows = &list.rows;
        let a = [load(simd, &rows[0], place), load(simd, &rows[1], place), load(simd, &rows[2], place)];
        let g = [load(simd, &rows[3], place), load(simd, &rows[4], place), load(simd, &rows[5], place)];
        let h = [load(simd, &rows[6], place), load(simd, &rows[7], place), load(simd, &rows[8], place)];
        let edge_error = load(simd, &rows[9], place);
        let plane_error = load(simd, &rows[10], place);
        let far = load(simd, &rows[11], place);
        let (b, c) = (plus(a, g), plus(a, h));
        let lanes = lanes & !self.beside([a, b, c], far);
        if lanes == 0 {
            return Answer::default();
        }
        let (a, b) = (from(a, self.views.centre), from(b, self.views.centre));
        // The caster's plane against both groups.
        let normal = cross(g, h);
        let height = -dot(normal, a);
        let light_height = dot_one(self.along, normal) + height;
        let spread = self.views_spread(normal) + plane_error;
        let light_spread = self.light_spread(normal) + plane_error;
        let below = bits((height + spread).simd_lt(0.0));
        let above = bits((height - spread).simd_gt(0.0));
        let light_below = bits((light_height + light_spread).simd_lt(0.0));
        let light_above = bits((light_height - light_spread).simd_gt(0.0));
        // Its edges.
        let (mut none_negative, mut none_positive) = (u16::MAX, u16::MAX);
        let (mut all_positive, mut all_negative) = (u16::MAX, u16::MAX);
        let mut answer = Answer::default();
        let (mut through_views, mut through_light) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, 0.0));
        let zero = f32x16::splat(simd, 0.0);
        let minus_h = [zero - h[0], zero - h[1], zero - h[2]];
        let bases = [a, b, a];
        let edges = [g, minus(h, g), minus_h];
        for k in 0..3 {
            let edge = edges[k];
            let m = cross(bases[k], edge);
            let middle = dot_one(self.along, m);
            let views = self.views_spread(cross_minus(self.along, edge, m));
            let light = self.light_spread(m);
            let rest = dot_one(self.cross, abs(edge)) + edge_error;
            let spread = views + light + rest;
            let positive = bits((middle - spread).simd_gt(0.0));
            let negative = bits((middle + spread).simd_lt(0.0));
            none_negative &= !negative;
            none_positive &= !positive;
            all_positive &= positive;
            all_negative &= negative;
            answer.edge[k] = !(positive | negative);
            through_views += views;
            through_light += light;
        }
        let misses = (below & light_below)
            | (above & light_above)
            | (!none_negative & !none_positive)
            | (below & !none_negative)
            | (above & !none_positive);
        answer.from_below = below & light_above & lanes;
        answer.from_above = above & light_below & lanes;
        answer.covers = (answer.from_below & all_positive) | (answer.from_above & all_negative);
        answer.open = lanes & !misses & !answer.covers;
        answer.views_wider = bits(through_views.simd_gt(through_light)) & answer.open;
        answer
    }
}

/// The sides that both boxes touch, x and y, upper and lower; all four at once, without branches.
#[inline(always)]
fn sides(views: &Slanted, light: &LightBox) -> [Side; 4] {
    let near = [views.high[0], views.high[1], views.low[0], views.low[1]];
    let far = [light.high[0], light.high[1], light.low[0], light.low[1]];
    let outward = [1.0, 1.0, -1.0, -1.0];
    let mut sides = [Side { slope: 0.0, limit: 0.0 }; 4];
    for k in 0..4 {
        let apart = far[k] - near[k];
        let widens = apart * outward[k] > 0.0;
        let z = if widens { [views.low[2], light.low[2]] } else { [views.high[2], light.high[2]] };
        let outer = if widens { far[k] } else { near[k] };
        let rise = z[1] - z[0];
        let size = z[0].abs() + z[1].abs();
        let slope = apart / rise;
        // Rounding of the slope and of the products moves the plane by a few steps.
        let room = 8.0 * f32::EPSILON * (near[k].abs() + far[k].abs() + slope.abs() * size);
        let tilted = near[k] - slope * z[0] + outward[k] * room;
        let is_flat = rise <= 1e-6 * size;
        sides[k] = Side { slope: if is_flat { 0.0 } else { slope }, limit: if is_flat { outer } else { tilted } };
    }
    sides
}
