//! Light samples against the planes of one (view-sample, caster), in f32, sixteen at a time;
//! sixteen boxes of sixteen before that, for a small caster misses most.
//!
//! Planes are scaled so that rounding moves no value by more than 1: above 1 a light sample is surely inside, below -1 surely outside,
//! between the two only exact arithmetic can tell. In f32, with u = 2^-24, coefficient and offset err by u each and a product by u, so
//! the three products by 3 u of the range over the light's box; the constant errs by u, and three sums of values below twice the range
//! plus the constant by u of that each. A plane that may cut the light has a constant no larger than its range and slack: 12 u of
//! the range in all, below 8e-7.

use super::light_box::{LANES, LightBox};
use super::view_planes::Planes;
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16};

/// What rounding may do to a value, of its range over the light's box.
const EVALUATED_ERROR: f64 = 1e-6;

/// The planes that cut the light, scaled.
#[derive(Clone, Copy, Debug)]
pub struct Sides {
    count: usize,
    /// The group that the next two are of.
    group: usize,
    /// Chunks of the group that may have a light sample inside.
    possible: u32,
    /// Chunks of the group all of which is inside.
    whole: u32,
    normal: [[f32; 3]; 4],
    constant: [f32; 4],
}

impl Sides {
    /// Those of `planes`.
    #[inline(always)]
    pub fn new(planes: &Planes, light: &LightBox) -> Self {
        let mut sides =
            Self { count: 0, group: usize::MAX, possible: 0, whole: 0, normal: [[0.0; 3]; 4], constant: [0.0; 4] };
        for k in (0..4).filter(|k| planes.cut[*k]) {
            // Rounding of the constant, which slack may lift above the range, is bounded by the last two terms.
            let slack = EVALUATED_ERROR * (planes.range[k] + planes.slack[k]) + planes.slack[k];
            let scale = if planes.turned[k] { -1.0 } else { 1.0 } / slack;
            let [x, y, z] = planes.normal[k];
            let along = |n: f64, half: f64| (n * half * scale) as f32;
            sides.normal[sides.count] = [along(x, light.half[0]), along(y, light.half[1]), along(z, light.half[2])];
            sides.constant[sides.count] = (planes.constant[k] * scale) as f32;
            sides.count += 1;
        }
        sides
    }

    /// How many planes cut the light.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.count
    }
}

/// How far inside, or outside, the box of a chunk is before its light samples are not looked at: past what rounding does to
/// their own values and to those of the box.
const CHUNK_MARGIN: f32 = 4.0;

/// Sorts out the chunks of a group by their boxes.
#[inline(always)]
fn sort_out<S: Simd>(simd: S, sides: &mut Sides, light: &LightBox, group: usize) {
    let boxes = &light.groups[group];
    let middle = boxes.middle.each_ref().map(|along| f32x16::from_slice(simd, along));
    let half = boxes.half.each_ref().map(|along| f32x16::from_slice(simd, along));
    let (mut most, mut least) = (f32x16::splat(simd, f32::MAX), f32x16::splat(simd, f32::MAX));
    for k in 0..sides.count {
        let [a, b, c] = sides.normal[k];
        let value = middle[0] * a + middle[1] * b + middle[2] * c + sides.constant[k];
        let spread = half[0] * a.abs() + half[1] * b.abs() + half[2] * c.abs();
        most = most.min(value + spread);
        least = least.min(value - spread);
    }
    sides.group = group;
    sides.possible = most.simd_ge(-CHUNK_MARGIN).to_bitmask() as u32;
    sides.whole = least.simd_gt(CHUNK_MARGIN).to_bitmask() as u32;
}

/// Light samples of mask word `word` that are surely inside all planes, and those in doubt.
#[inline(always)]
pub fn sides<S: Simd>(simd: S, sides: &mut Sides, light: &LightBox, word: usize) -> [u32; 2] {
    if sides.group != 2 * word / LANES {
        sort_out(simd, sides, light, 2 * word / LANES);
    }
    let (mut inside, mut doubtful) = (0, 0);
    for half in 0..2 {
        let lane = (2 * word + half) % LANES;
        if sides.possible >> lane & 1 == 0 {
            continue;
        }
        if sides.whole >> lane & 1 == 1 {
            inside |= 0xffff << (16 * half);
            continue;
        }
        let chunk = &light.chunks[2 * word + half];
        let x = f32x16::from_slice(simd, &chunk.x);
        let y = f32x16::from_slice(simd, &chunk.y);
        let z = f32x16::from_slice(simd, &chunk.z);
        let value = |k: usize| {
            let [a, b, c] = sides.normal[k].map(|n| f32x16::splat(simd, n));
            x.mul_add(a, y.mul_add(b, z.mul_add(c, f32x16::splat(simd, sides.constant[k]))))
        };
        let mut least = value(0);
        for k in 1..sides.count {
            least = least.min(value(k));
        }
        let sure = least.simd_gt(1.0).to_bitmask() as u32;
        let may = least.simd_ge(-1.0).to_bitmask() as u32;
        inside |= sure << (16 * half);
        doubtful |= (may & !sure) << (16 * half);
    }
    [inside, doubtful]
}
