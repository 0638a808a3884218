//! Casters that hide much come first: the leaves end when all their segments are blocked.
//!
//! What a triangle hides, as the middle of the cluster sees it, is about its normal times its middle over the cube of its distance. The order
//! holds for every shaft of the cluster, as narrowing keeps it. Only the power of two is sorted by.

use super::LANES;
use super::candidates::Candidates;
use super::shaft::{TINY, cross, dot, load, plus};
use fearless_simd::{Simd, SimdBase, SimdFloat, f32x16};

/// Exponents of f32.
const POWERS: usize = 256;

/// What a thread keeps.
#[derive(Default)]
pub struct Order {
    power: Vec<u8>,
    places: Vec<u32>,
}

impl Order {
    /// Puts all candidates on the stack once more, the largest as seen from the origin first; those of one power stay as they were.
    #[inline(always)]
    pub fn push_sorted<S: Simd>(&mut self, simd: S, list: &mut Candidates) {
        let count = list.len;
        list.reserve(count + LANES);
        self.power.clear();
        let mut next = [0u32; POWERS];
        for place in (0..count).step_by(LANES) {
            let hidden = hides(simd, list, place);
            for hidden in &hidden.as_slice()[..LANES.min(count - place)] {
                let power = 255 - (hidden.to_bits() >> 23 & 255);
                next[power as usize] += 1;
                self.power.push(power as u8);
            }
        }
        let mut sum = 0;
        for count in &mut next {
            (*count, sum) = (sum, sum + *count);
        }
        self.places.resize(count, 0);
        for (from, power) in (0u32..).zip(&self.power) {
            let to = &mut next[usize::from(*power)];
            self.places[*to as usize] = from;
            *to += 1;
        }
        for row in &mut list.rows {
            let (from, to) = row.split_at_mut(count);
            self.places.iter().zip(to).for_each(|(place, to)| *to = from[*place as usize]);
        }
        for row in [&mut list.slot, &mut list.flags] {
            let (from, to) = row.split_at_mut(count);
            self.places.iter().zip(to).for_each(|(place, to)| *to = from[*place as usize]);
        }
        list.len = 2 * count;
    }
}

/// What sixteen casters hide.
#[inline(always)]
fn hides<S: Simd>(simd: S, list: &Candidates, place: usize) -> f32x16<S> {
    let rows = &list.rows;
    let a = [load(simd, &rows[0], place), load(simd, &rows[1], place), load(simd, &rows[2], place)];
    let g = [load(simd, &rows[3], place), load(simd, &rows[4], place), load(simd, &rows[5], place)];
    let h = [load(simd, &rows[6], place), load(simd, &rows[7], place), load(simd, &rows[8], place)];
    let sum = plus(g, h);
    let third = 1.0 / 3.0;
    let middle = [sum[0].mul_add(third, a[0]), sum[1].mul_add(third, a[1]), sum[2].mul_add(third, a[2])];
    let square = dot(middle, middle) + TINY;
    dot(cross(g, h), middle).abs() / (square * square.sqrt() + TINY)
}
