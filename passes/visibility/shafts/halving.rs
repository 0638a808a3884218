//! Points put in blocks of sixteen, in the order of a tree of groups: halved again and again, all in registers.
//!
//! Where to cut a side is found by halving the interval that holds the cut and counting; what goes to either half is pressed together.
//! A light of a thousand samples is put in order once for every cluster.

use super::groups::{Blocks, Frame};
use super::shaft::{dot, dot_one, from, load};
use super::{LANES, lanes_from};
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, mask32x16, u32x16};

/// Depth counts for less than width when the light is divided: light samples behind each other see much the same.
const DEPTH_WEIGHT: f32 = 0.25;
/// Halvings of a side until what is left between is taken as it comes.
const SPLIT_STEPS: usize = 8;

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
            longest = longest.max(lanes.select(dot(at, at), f32x16::splat(simd, 0.0)));
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
}
