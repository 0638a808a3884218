//! From the number of casters before one light sample to that before each other: every edge with a jump adds it to the light samples
//! that lie behind it as the chosen one sees them.
//!
//! With all directions taken from the view-sample, the way from the chosen light sample c to another l crosses the edge from a to b where
//! det(a, b, c) and det(a, b, l) differ in sign and det(c, l, a) and det(c, l, b) do, the four signs together saying that it is the edge and
//! not its mirror image: l is inside three planes through the view-sample, as it is inside a caster's. On crossing it, those casters at the
//! edge are lost that have their third corner on the side of c, and those on the other side won.
//!
//! Counters are bits of binary numbers, a word of light samples at a time; what overflows comes back, for no count is negative in the end.

use super::ask::strictly;
use super::cell::Cell;
use super::meet::{Met, View};
use crate::shared::light_box::LightBox;
use crate::shared::light_sides::{Sides, sides};
use crate::shared::predicate;
use crate::shared::pyramid::{cross, dot, size};
use crate::shared::soft::Soft;
use crate::shared::view_planes::Planes;
use fearless_simd::Simd;

/// 128 e, as in [`crate::shared::view_planes`].
const ERROR: f64 = 1.45e-14;

/// Counters of a view-sample.
#[derive(Default)]
pub struct Counters {
    /// Bit k of all counters, then bit k + 1.
    planes: Vec<u32>,
    words: usize,
    /// Light samples in doubt.
    pub doubts: Vec<u32>,
    /// Edges whose jump was added.
    pub crossing: u64,
}

/// The chosen light sample cannot be told apart from a border.
pub struct BadChoice;

fn minus(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    [f64::from(a[0]) - f64::from(b[0]), f64::from(a[1]) - f64::from(b[1]), f64::from(a[2]) - f64::from(b[2])]
}

/// Sets plane `k`, of which some of the light may be on either side.
#[inline(always)]
fn set(
    planes: &mut Planes,
    k: usize,
    light: &LightBox,
    to_light: [f64; 3],
    normal: [f64; 3],
    slack: f64,
    turned: bool,
) {
    let range = normal[0].abs() * light.half[0] + normal[1].abs() * light.half[1] + normal[2].abs() * light.half[2];
    (planes.normal[k], planes.constant[k], planes.slack[k]) = (normal, dot(normal, to_light), slack);
    (planes.range[k], planes.turned[k], planes.cut[k]) = (range, turned, true);
}

impl Counters {
    /// Sets every counter to the number of casters before light sample `chosen`, and adds what changes on the way to the others.
    #[inline(always)]
    pub fn count<S: Simd>(
        &mut self,
        simd: S,
        soft: &Soft,
        cell: &Cell,
        met: &mut Met,
        view: &View,
        joined: i32,
    ) -> Result<(), BadChoice> {
        let (light, position, chosen) = (&soft.light, view.position, view.sample);
        let single = met.count + doubtful(soft, cell, met, position, light.samples[chosen])?;
        let before = single.wrapping_add_signed(joined);
        self.words = light.words();
        self.doubts.clear();
        self.doubts.resize(self.words, 0);
        self.planes.clear();
        // No counter can end higher.
        let bits = u32::BITS - before.saturating_add(met.sum_up()).leading_zeros();
        for bit in 0..bits {
            let set = if before >> bit & 1 == 1 { u32::MAX } else { 0 };
            self.planes.extend((0..self.words).map(|_| set));
        }
        let to_light = minus(light.middle, position);
        let to_chosen = minus(light.samples[chosen], position);
        let far = ERROR * (size(to_light) + light.half.iter().sum::<f64>());
        let (mut planes, mut crossing) = (Planes::EMPTY, 0);
        for (edge, jump) in &met.changes {
            let [a, b] = cell.ends[*edge as usize];
            let (from, to, line) = (minus(a, position), minus(b, position), minus(b, a));
            let normal = cross(from, line);
            let lengths = size(from) * size(line);
            if dot(normal, to_light).abs() > light.spread(normal) * (1.0 + 1e-12) + far * lengths {
                continue;
            }
            let value = dot(normal, to_chosen);
            let side = if value.abs() > ERROR * size(to_chosen) * lengths {
                value > 0.0
            } else {
                match predicate::side(&[a, b, light.samples[chosen]], position) {
                    0 => return Err(BadChoice),
                    side => side > 0,
                }
            };
            set(&mut planes, 0, light, to_light, normal, far * lengths, side);
            // These two go through the chosen light sample: they cut the light.
            let reach = far * size(to_chosen);
            set(&mut planes, 1, light, to_light, cross(from, to_chosen), reach * size(from), side);
            set(&mut planes, 2, light, to_light, cross(to, to_chosen), reach * size(to), !side);
            crossing += 1;
            let change = if side { -*jump } else { *jump };
            let mut behind = Sides::new(&planes, light);
            for word in 0..self.words {
                let [inside, doubtful] = sides(simd, &mut behind, light, word);
                self.doubts[word] |= doubtful;
                if inside != 0 {
                    self.add(word, inside, change);
                }
            }
        }
        self.crossing += crossing;
        Ok(())
    }

    /// Adds `change` to the counters `which` of `word`.
    #[inline(always)]
    fn add(&mut self, word: usize, which: u32, change: i32) {
        let amount = change.unsigned_abs();
        let mut first = 0;
        while amount >> first != 0 {
            if amount >> first & 1 == 1 {
                let mut carry = which;
                let mut at = first as usize * self.words + word;
                while carry != 0 && at < self.planes.len() {
                    let bits = self.planes[at];
                    self.planes[at] = bits ^ carry;
                    carry &= if change > 0 { bits } else { !bits };
                    at += self.words;
                }
            }
            first += 1;
        }
    }

    /// Light samples of `word` before which some caster stands.
    pub fn blocked(&self, word: usize) -> u32 {
        self.planes.iter().skip(word).step_by(self.words).fold(0, |any, bits| any | bits)
    }
}

/// How many of the doubtful casters hide `light` from `position`.
fn doubtful(soft: &Soft, cell: &Cell, met: &Met, position: [f32; 3], light: [f32; 3]) -> Result<u32, BadChoice> {
    let mut count = 0;
    for slot in &met.doubtful {
        let caster = &soft.triangles[cell.slots[*slot as usize].triangle as usize];
        count += u32::from(strictly(caster, position, light).ok_or(BadChoice)?);
    }
    Ok(count)
}
