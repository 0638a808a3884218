//! A binary tree over triangles, made fast: it is walked once for every cluster, not once for every ray.
//!
//! Triangles are put along a curve through space (Morton 1966), the large apart from the small, as their boxes would widen every box
//! they share. Ranges of the curve are halved where its highest bit changes, as Lauterbach et al. 2009 do; once they are short, where the areas of
//! both boxes, weighted by the registers of triangles to be looked at, come to least.

use crate::shared::predicate::Corners;
use rayon::prelude::*;

/// Smallest and largest coordinates.
pub type Box3 = ([f32; 3], [f32; 3]);

/// Ranges that are short enough for all places of a cut to be tried.
const SHORT: usize = 256;
/// Ranges worth a thread of their own.
const LONG: usize = 8192;
/// Bits of the curve's cells along each axis.
const BITS: u32 = 10;
/// Each class of sizes is this much smaller than the one before, beginning with the whole scene; the last holds the rest.
const CLASS_RATIO: f32 = 0.25;
const CLASSES: u32 = 4;
/// Bits of a digit when keys are sorted; three digits hold a key.
const DIGIT: u32 = 11;

/// A node.
pub struct Tree {
    /// Around its triangles.
    pub bounds: Box3,
    /// First place.
    pub first: u32,
    /// Places.
    pub count: u32,
    /// None: a run.
    pub halves: Option<Box<[Tree; 2]>>,
}

fn join(a: Box3, b: Box3) -> Box3 {
    ([0, 1, 2].map(|k| a.0[k].min(b.0[k])), [0, 1, 2].map(|k| a.1[k].max(b.1[k])))
}

fn area((low, high): Box3) -> f32 {
    let [x, y, z] = [0, 1, 2].map(|k| high[k] - low[k]);
    x * y + y * z + z * x
}

const NOTHING: Box3 = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);

impl Tree {
    /// Half of the surface.
    pub fn area(&self) -> f32 {
        area(self.bounds)
    }
}

/// Triangles in the order of runs of at most `most`, and the tree over their places. There is at least one, and all are finite.
pub fn divide(triangles: &[Corners], most: usize) -> (Vec<u32>, Tree) {
    let boxes: Vec<Box3> =
        triangles.par_iter().map(|corners| corners.iter().fold(NOTHING, |all, p| join(all, (*p, *p)))).collect();
    let all = boxes.par_iter().copied().reduce(|| NOTHING, join);
    let extent = [0, 1, 2].map(|k| all.1[k] - all.0[k]);
    let widest = extent.iter().fold(f32::MIN_POSITIVE, |widest, x| widest.max(*x));
    let cells = ((1 << BITS) - 1) as f32;
    let key = |(low, high): &Box3| {
        let size = [0, 1, 2].map(|k| high[k] - low[k]).iter().fold(0.0, |size: f32, x| size.max(*x));
        let mut class = 0;
        let mut limit = widest * CLASS_RATIO;
        while class + 1 < CLASSES && size < limit {
            (class, limit) = (class + 1, limit * CLASS_RATIO);
        }
        (0..3).fold(class << (3 * BITS), |key, k| {
            let middle = 0.5 * (low[k] - all.0[k]) + 0.5 * (high[k] - all.0[k]);
            key | spread((middle / widest * cells) as u32) << k
        })
    };
    let mut keys: Vec<[u32; 2]> =
        boxes.par_iter().zip(0u32..boxes.len() as u32).map(|(bounds, at)| [key(bounds), at]).collect();
    sort(&mut keys);
    let boxes: Vec<Box3> = keys.par_iter().map(|[_, at]| boxes[*at as usize]).collect();
    let tree = Ranges { keys: &keys, boxes: &boxes, most }.tree(0, keys.len());
    (keys.iter().map(|[_, at]| *at).collect(), tree)
}

/// Each of ten bits at every third place.
fn spread(x: u32) -> u32 {
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

/// By key, digit by digit.
fn sort(keys: &mut Vec<[u32; 2]>) {
    let mut other = vec![[0; 2]; keys.len()];
    for digit in 0..32u32.div_ceil(DIGIT) {
        let of = |key: u32| (key >> (digit * DIGIT) & ((1 << DIGIT) - 1)) as usize;
        let mut next = [0u32; 1 << DIGIT];
        for [key, _] in keys.iter() {
            next[of(*key)] += 1;
        }
        let mut sum = 0;
        for count in &mut next {
            (*count, sum) = (sum, sum + *count);
        }
        for entry in keys.iter() {
            let place = &mut next[of(entry[0])];
            other[*place as usize] = *entry;
            *place += 1;
        }
        std::mem::swap(keys, &mut other);
    }
}

struct Ranges<'a> {
    keys: &'a [[u32; 2]],
    boxes: &'a [Box3],
    most: usize,
}

impl Ranges<'_> {
    fn tree(&self, first: usize, last: usize) -> Tree {
        let count = last - first;
        if count <= self.most {
            let bounds = self.boxes[first..last].iter().copied().fold(NOTHING, join);
            return Tree { bounds, first: first as u32, count: count as u32, halves: None };
        }
        let cut = if count <= SHORT { self.best_cut(first, last) } else { self.bit_cut(first, last) };
        let (a, b) = if count >= LONG {
            rayon::join(|| self.tree(first, cut), || self.tree(cut, last))
        } else {
            (self.tree(first, cut), self.tree(cut, last))
        };
        let bounds = join(a.bounds, b.bounds);
        Tree { bounds, first: first as u32, count: count as u32, halves: Some(Box::new([a, b])) }
    }

    /// Where the highest bit in which the range's keys differ is first set; the middle when they are equal.
    fn bit_cut(&self, first: usize, last: usize) -> usize {
        let (low, high) = (self.keys[first][0], self.keys[last - 1][0]);
        if low == high {
            return first.midpoint(last);
        }
        let bit = 1 << (low ^ high).ilog2();
        first + self.keys[first..last].partition_point(|[key, _]| key & bit == 0)
    }

    /// Where areas times registers come to least. Ties, as of points, go to the middle.
    fn best_cut(&self, first: usize, last: usize) -> usize {
        let count = last - first;
        let weight = |count: usize| count.div_ceil(self.most) as f32;
        let mut before = [0.0; SHORT];
        let mut all = NOTHING;
        for (at, before) in before[..count].iter_mut().enumerate() {
            *before = area(all) * weight(at);
            all = join(all, self.boxes[first + at]);
        }
        let (mut best, mut cut) = (f32::INFINITY, count / 2);
        let mut all = NOTHING;
        for at in (1..count).rev() {
            all = join(all, self.boxes[first + at]);
            let cost = before[at] + area(all) * weight(count - at);
            if cost < best || (cost == best && at.abs_diff(count / 2) < cut.abs_diff(count / 2)) {
                (best, cut) = (cost, at);
            }
        }
        first + cut
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(tree: &Tree, triangles: &[Corners], order: &[u32], most: u32) {
        let places = &order[tree.first as usize..(tree.first + tree.count) as usize];
        let around = places.iter().flat_map(|&at| triangles[at as usize]).fold(NOTHING, |all, p| join(all, (p, p)));
        assert_eq!(tree.bounds, around);
        match tree.halves.as_deref() {
            None => assert!(0 < tree.count && tree.count <= most),
            Some([a, b]) => {
                assert_eq!([a.first, b.first, a.count + b.count], [tree.first, tree.first + a.count, tree.count]);
                check(a, triangles, order, most);
                check(b, triangles, order, most);
            }
        }
    }

    #[test]
    fn every_triangle_has_one_place_and_lies_in_the_boxes_above_it() {
        let mut seed = 1u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32
        };
        for count in [1, 15, 16, 17, 255, 256, 257, 300, 20_000] {
            // Of all sizes; every third time all equal.
            let large: Vec<Corners> = (0..count)
                .map(|_| {
                    let (centre, size) = ([next(), next(), next()], next().powi(8));
                    [0; 3].map(|_| centre.map(|x| x + size * (next() - 0.5)))
                })
                .collect();
            let triangles = if count % 3 == 0 { vec![large[0]; count] } else { large };
            let (order, tree) = divide(&triangles, 16);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..count as u32), "{count}");
            check(&tree, &triangles, &order, 16);
        }
    }
}
