//! A cluster of view-samples and the light as it sees it: one frame for both, and a binary tree of groups over each.
//!
//! The frame stands in the middle of the cluster, z towards the light, x along the cluster's longer side. Groups end in blocks of
//! sixteen, which fill a register. A group of view-samples lies in a slanted box: its points are
//! centre + a (X, 0, p X) + b (0, Y, q Y) + c (0, 0, r) with |a|, |b|, |c| <= 1, for a surface is flat and slanted rather than
//! thick. A group of light samples lies in a plain box.

use super::shaft::{dot as vector_dot, dot_one, from, load};
use super::{LANES, lanes_from};
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, mask32x16, u32x16};

/// A step of f32 at 1, with room: what rounding may do to a coordinate, as a share of it.
const COORDINATE_ERROR: f32 = 8.0 * f32::EPSILON;
/// Depth counts for less than width when the light is divided: light samples behind each other see much the same.
const DEPTH_WEIGHT: f32 = 0.25;
/// Steepest slant that is followed; what is steeper is nearly parallel to the light's direction.
const STEEPEST: f32 = 32.0;
/// Halvings of a side until what is left between is taken as it comes.
const SPLIT_STEPS: usize = 8;

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
    upper: [Vec<f32>; 3],
    upper_index: Vec<u32>,
}

/// Points by coordinate, filled up to whole registers.
#[derive(Default)]
pub struct Points {
    at: [Vec<f32>; 3],
    count: usize,
}

impl Points {
    /// Takes `points` in place of what was there.
    pub fn fill(&mut self, points: impl Iterator<Item = [f32; 3]>) {
        self.at.iter_mut().for_each(Vec::clear);
        for point in points {
            for (along, x) in self.at.iter_mut().zip(point) {
                along.push(x);
            }
        }
        self.count = self.at[0].len();
        let padded = self.count.next_multiple_of(LANES);
        self.at.iter_mut().for_each(|along| along.resize(padded, 0.0));
    }
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
    /// Puts `points` in order, as `frame` sees them; `index` tells what each was.
    #[inline(always)]
    pub fn fill<S: Simd>(&mut self, simd: S, frame: &Frame, points: &Points, index: &[u32]) {
        self.count = points.count;
        let padded = self.count.next_multiple_of(LANES);
        let [x, y, z] = &points.at;
        for along in &mut self.at {
            along.resize(padded, 0.0);
        }
        let mut longest = f32x16::splat(simd, 0.0);
        for first in (0..self.count).step_by(LANES) {
            let point = [load(simd, x, first), load(simd, y, first), load(simd, z, first)];
            let point = from(point, frame.origin);
            let at = [dot_one(frame.axes[0], point), dot_one(frame.axes[1], point), dot_one(frame.axes[2], point)];
            for (along, values) in self.at.iter_mut().zip(at) {
                values.store_slice(&mut along[first..first + LANES]);
            }
            let lanes = mask32x16::from_bitmask(simd, u64::from(lanes_from(self.count - first)));
            longest = longest.max(lanes.select(vector_dot(at, at), f32x16::splat(simd, 0.0)));
        }
        self.reach = longest.as_slice().iter().fold(0.0, |most: f32, square| most.max(*square)).sqrt() * (1.0 + 1e-6);
        self.index.clear();
        self.index.extend_from_slice(index);
        self.index.resize(padded, 0);
        for along in &mut self.upper {
            along.resize(padded + LANES, 0.0);
        }
        self.upper_index.resize(padded + LANES, 0);
        self.divide(simd, 0..self.count);
        if let Some(last) = self.count.checked_sub(1) {
            for along in &mut self.at {
                let value = along[last];
                along[self.count..].fill(value);
            }
            let value = self.index[last];
            self.index[self.count..].fill(value);
        }
    }

    /// Puts points in an order whose blocks, and whose halves of blocks, lie together.
    #[inline(always)]
    fn divide<S: Simd>(&mut self, simd: S, points: std::ops::Range<usize>) {
        // Children are put off, not called: a function that calls itself is not compiled for the instruction set around it.
        let mut waiting = [(0, 0); usize::BITS as usize];
        let mut count = 1;
        waiting[0] = (points.start, points.end);
        while count > 0 {
            count -= 1;
            let (first, end) = waiting[count];
            let blocks = (end - first).div_ceil(LANES);
            if blocks >= 2 {
                let middle = first + blocks.div_ceil(2) * LANES;
                self.split(simd, first, middle, end);
                waiting[count] = (middle, end);
                waiting[count + 1] = (first, middle);
                count += 2;
            }
        }
    }

    /// Brings the points `first..end` that are lowest along their longest side before `middle`, as near as steps of a 256th of it tell.
    #[inline(always)]
    fn split<S: Simd>(&mut self, simd: S, first: usize, middle: usize, end: usize) {
        let mut ends = [(0.0, 0.0); 3];
        for (along, ends) in self.at.iter().zip(&mut ends) {
            let (mut low, mut high) = (f32x16::splat(simd, f32::MAX), f32x16::splat(simd, f32::MIN));
            for place in (first..end).step_by(LANES) {
                // Where the last register is not full, what lies beyond repeats nothing: it is left out.
                let lanes = mask32x16::from_bitmask(simd, u64::from(lanes_from(end - place)));
                let x = load(simd, along, place);
                low = low.min(lanes.select(x, low));
                high = high.max(lanes.select(x, high));
            }
            *ends = (
                low.as_slice().iter().fold(f32::MAX, |a, b| a.min(*b)),
                high.as_slice().iter().fold(f32::MIN, |a, b| a.max(*b)),
            );
        }
        let extent = |axis: usize, weight: f32| (ends[axis].1 - ends[axis].0) * weight;
        let extent = [extent(0, 1.0), extent(1, 1.0), extent(2, DEPTH_WEIGHT)];
        let axis = if extent[0] >= extent[1] && extent[0] >= extent[2] {
            0
        } else if extent[1] >= extent[2] {
            1
        } else {
            2
        };
        // Below `from` lie no more than wanted, below `to` no less; both ends come nearer.
        let wanted = middle - first;
        let (mut from, mut to, mut highest) = (ends[axis].0, f32::INFINITY, ends[axis].1);
        let mut below = 0;
        for _ in 0..SPLIT_STEPS {
            let limit = 0.5 * (from + highest);
            let mut count = 0;
            for place in (first..end).step_by(LANES) {
                let lanes = lanes_from(end - place);
                count += (load(simd, &self.at[axis], place).simd_lt(limit).to_bitmask() as u16 & lanes).count_ones();
            }
            if count as usize <= wanted {
                (from, below) = (limit, count as usize);
                if below == wanted {
                    break;
                }
            } else {
                (to, highest) = (limit, limit);
            }
        }
        let mut quota = wanted - below;
        let (mut lower, mut upper) = (first, 0);
        for place in (first..end).step_by(LANES) {
            let lanes = lanes_from(end - place);
            let x = load(simd, &self.at[axis], place);
            let mut low = x.simd_lt(from).to_bitmask() as u16 & lanes;
            let mut between = x.simd_lt(to).to_bitmask() as u16 & lanes & !low;
            if between.count_ones() as usize > quota {
                for _ in 0..quota {
                    let bit = between & between.wrapping_neg();
                    low |= bit;
                    between ^= bit;
                }
                quota = 0;
            } else {
                low |= between;
                quota -= between.count_ones() as usize;
            }
            let to_lower = mask32x16::from_bitmask(simd, u64::from(low));
            let to_upper = mask32x16::from_bitmask(simd, u64::from(lanes & !low));
            for (along, kept) in self.at.iter_mut().zip(&mut self.upper) {
                let x = load(simd, along, place);
                x.compress(to_upper).store_slice(&mut kept[upper..upper + LANES]);
                x.compress(to_lower).store_slice(&mut along[lower..lower + LANES]);
            }
            let x = u32x16::from_slice(simd, &self.index[place..place + LANES]);
            x.compress(to_upper).store_slice(&mut self.upper_index[upper..upper + LANES]);
            x.compress(to_lower).store_slice(&mut self.index[lower..lower + LANES]);
            lower += low.count_ones() as usize;
            upper += (lanes & !low).count_ones() as usize;
        }
        for (along, kept) in self.at.iter_mut().zip(&self.upper) {
            along[lower..end].copy_from_slice(&kept[..upper]);
        }
        self.index[lower..end].copy_from_slice(&self.upper_index[..upper]);
    }

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
