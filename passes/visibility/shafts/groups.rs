//! A cluster of view-samples and the light as it sees it: one frame for both, and a binary tree of groups over each.
//!
//! The frame stands in the middle of the cluster, z towards the light, x along the cluster's longer side. Groups end in blocks of
//! sixteen, which fill a register. A group of view-samples lies in a slanted box: its points are
//! centre + a (X, 0, p X) + b (0, Y, q Y) + c (0, 0, r) with |a|, |b|, |c| <= 1, for a surface is flat and slanted rather than
//! thick. A group of light samples lies in a plain box.

use super::LANES;
use super::shaft::load;
use fearless_simd::{Simd, SimdBase};

/// A step of f32 at 1, with room: what rounding may do to a coordinate, as a share of it.
const COORDINATE_ERROR: f32 = 8.0 * f32::EPSILON;
/// Steepest slant that is followed; what is steeper is nearly parallel to the light's direction.
const STEEPEST: f32 = 32.0;

/// A linear map from the scene to a cluster's own space.
#[derive(Clone, Copy, Debug, Default)]
pub struct Frame {
    /// Middle of the cluster.
    pub origin: [f32; 3],
    /// Directions.
    pub axes: [[f32; 3]; 3],
}

/// A slanted box of view-samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slanted {
    /// Middle.
    pub centre: [f32; 3],
    /// X and Y.
    pub half: [f32; 2],
    /// p and q.
    pub slope: [f32; 2],
    /// r.
    pub rest: f32,
    /// Plain box around it.
    pub low: [f32; 3],
    /// Plain box around it.
    pub high: [f32; 3],
}

/// A box of light samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightBox {
    /// Smallest coordinates.
    pub low: [f32; 3],
    /// Largest coordinates.
    pub high: [f32; 3],
}

/// Points in blocks of sixteen, in the order of a tree of groups; the last block is filled up with its last point.
#[derive(Default)]
pub struct Blocks {
    /// Coordinates.
    pub at: [Vec<f32>; 3],
    /// What each point was.
    pub index: Vec<u32>,
    /// Points that are not filling.
    pub count: usize,
    /// Largest length.
    pub reach: f32,
    /// Memory of [`Self::split`]: what goes to the upper half.
    pub(super) upper: [Vec<f32>; 3],
    /// See `upper`.
    pub(super) upper_index: Vec<u32>,
}

/// A node of a tree over blocks: `first..last`, and its place when children of i are 2 i + 1 and 2 i + 2.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// Place in the tree.
    pub node: usize,
    /// First block.
    pub first: usize,
    /// Last block but one.
    pub last: usize,
}

impl Range {
    /// Blocks.
    pub fn len(&self) -> usize {
        self.last - self.first
    }
    /// Both halves.
    pub fn halves(&self) -> [Self; 2] {
        let middle = self.first + self.len().div_ceil(2);
        [
            Self { node: 2 * self.node + 1, first: self.first, last: middle },
            Self { node: 2 * self.node + 2, first: middle, last: self.last },
        ]
    }
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn size(a: [f32; 3]) -> f32 {
    a[0].abs() + a[1].abs() + a[2].abs()
}

fn unit(a: [f32; 3]) -> Option<[f32; 3]> {
    let length = dot(a, a).sqrt();
    (length > 1e-18).then(|| a.map(|x| x / length))
}

impl Frame {
    /// One for view-samples at `points` and a light around `light`.
    pub fn new(points: &[[f32; 3]], light: [f32; 3]) -> Self {
        let share = 1.0 / points.len() as f32;
        let origin = points.iter().fold([0.0; 3], |sum: [f32; 3], p| [0, 1, 2].map(|k| sum[k] + share * p[k]));
        let z = unit(minus(light, origin)).unwrap_or([0.0, 0.0, 1.0]);
        let aside = if z[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let x = unit(cross(aside, z)).unwrap_or([0.0, 1.0, 0.0]);
        let y = cross(z, x);
        // Turned about z until x is the long side.
        let mut spread = [0.0f32; 3];
        for point in points {
            let offset = minus(*point, origin);
            let (u, v) = (dot(offset, x), dot(offset, y));
            spread = [spread[0] + u * u, spread[1] + u * v, spread[2] + v * v];
        }
        let (sin, cos) = (0.5 * (2.0 * spread[1]).atan2(spread[0] - spread[2])).sin_cos();
        let turned = [0, 1, 2].map(|k| cos * x[k] + sin * y[k]);
        Self { origin, axes: [turned, cross(z, turned), z] }
    }

    /// A direction.
    #[inline(always)]
    pub fn turn(&self, direction: [f32; 3]) -> [f32; 3] {
        self.axes.map(|axis| dot(axis, direction))
    }

    /// A point.
    #[inline(always)]
    pub fn point(&self, point: [f32; 3]) -> [f32; 3] {
        self.turn(minus(point, self.origin))
    }
}

impl Blocks {
    /// All of them.
    pub fn root(&self) -> Range {
        Range { node: 0, first: 0, last: self.count.div_ceil(LANES) }
    }

    /// Point `place`.
    pub fn point(&self, place: usize) -> [f32; 3] {
        [self.at[0][place], self.at[1][place], self.at[2][place]]
    }

    /// Smallest and largest coordinates of a range.
    fn bounds(&self, range: Range) -> ([f32; 3], [f32; 3]) {
        let ends = self.at.each_ref().map(|along| {
            let along = &along[range.first * LANES..range.last * LANES];
            let mut ends = ([f32::MAX; LANES], [f32::MIN; LANES]);
            for block in along.chunks_exact(LANES) {
                for (lane, x) in block.iter().enumerate() {
                    ends.0[lane] = ends.0[lane].min(*x);
                    ends.1[lane] = ends.1[lane].max(*x);
                }
            }
            (ends.0.iter().fold(f32::MAX, |a, b| a.min(*b)), ends.1.iter().fold(f32::MIN, |a, b| a.max(*b)))
        });
        (ends.map(|end| end.0), ends.map(|end| end.1))
    }

    /// The boxes around blocks.
    #[inline(always)]
    pub fn light_boxes<S: Simd>(&self, simd: S, boxes: &mut [LightBox]) {
        let pad = COORDINATE_ERROR * self.reach;
        for (block, around) in boxes.iter_mut().enumerate() {
            for k in 0..3 {
                let x = load(simd, &self.at[k], block * LANES);
                let ends = x.as_slice().iter().fold((f32::MAX, f32::MIN), |(low, high), x| {
                    (if *x < low { *x } else { low }, if *x > high { *x } else { high })
                });
                (around.low[k], around.high[k]) = (ends.0 - pad, ends.1 + pad);
            }
        }
    }

    /// The slanted box around a range.
    pub fn slanted(&self, range: Range) -> Slanted {
        let (low, high) = self.bounds(range);
        let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let places = range.first * LANES..range.last * LANES;
        let [x, y, z] = self.at.each_ref().map(|along| &along[places.clone()]);
        // Sums of xx, xy, yy, xz, yz, x, y, z about the middle.
        let mut sums = [0.0f32; 8];
        for ((x, y), z) in x.iter().zip(y).zip(z) {
            let (x, y, z) = (x - middle[0], y - middle[1], z - middle[2]);
            for (sum, term) in sums.iter_mut().zip([x * x, x * y, y * y, x * z, y * z, x, y, z]) {
                *sum += term;
            }
        }
        let n = x.len() as f32;
        let [mx, my, mz] = [sums[5] / n, sums[6] / n, sums[7] / n];
        let [xx, xy, yy, xz, yz] = [
            sums[0] - n * mx * mx,
            sums[1] - n * mx * my,
            sums[2] - n * my * my,
            sums[3] - n * mx * mz,
            sums[4] - n * my * mz,
        ];
        let whole = xx * yy - xy * xy;
        let mut slope = if whole > 1e-3 * xx * yy {
            [(xz * yy - yz * xy) / whole, (yz * xx - xz * xy) / whole]
        } else if xx > 0.0 {
            [xz / xx, 0.0]
        } else {
            [0.0; 2]
        };
        if !slope.iter().all(|slope| slope.abs() < STEEPEST) {
            slope = [0.0; 2];
        }
        let mut ends = (f32::MAX, f32::MIN);
        for ((x, y), z) in x.iter().zip(y).zip(z) {
            let rest = z - slope[0] * (x - middle[0]) - slope[1] * (y - middle[1]);
            ends = (ends.0.min(rest), ends.1.max(rest));
        }
        if ends.1 - ends.0 > 0.8 * (high[2] - low[2]) {
            (slope, ends) = ([0.0; 2], (low[2], high[2]));
        }
        let pad = COORDINATE_ERROR * self.reach * (1.0 + slope[0].abs() + slope[1].abs());
        Slanted {
            centre: [middle[0], middle[1], 0.5 * (ends.0 + ends.1)],
            half: [0.5 * (high[0] - low[0]) + pad, 0.5 * (high[1] - low[1]) + pad],
            slope,
            rest: 0.5 * (ends.1 - ends.0) + pad,
            low: low.map(|x| x - pad),
            high: high.map(|x| x + pad),
        }
    }
}

/// Places in a tree over `blocks` blocks.
pub fn tree_len(blocks: usize) -> usize {
    2 * blocks.next_power_of_two()
}

/// Puts the boxes around `range` and all its parts into `boxes`, by node.
pub fn join_boxes(range: Range, of_blocks: &[LightBox], boxes: &mut [LightBox]) -> LightBox {
    let around = if range.len() > 1 {
        let [a, b] = range.halves().map(|half| join_boxes(half, of_blocks, boxes));
        LightBox { low: [0, 1, 2].map(|k| a.low[k].min(b.low[k])), high: [0, 1, 2].map(|k| a.high[k].max(b.high[k])) }
    } else {
        of_blocks[range.first]
    };
    boxes[range.node] = around;
    around
}

/// Calls `visit` with every node of the tree over `range`.
pub fn every(range: Range, visit: &mut impl FnMut(Range)) {
    visit(range);
    if range.len() > 1 {
        for half in range.halves() {
            every(half, visit);
        }
    }
}
