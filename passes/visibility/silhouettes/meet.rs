//! One view-sample against the casters of its cell, sixteen at a time: which of them may hide a part of the light, which hide all of
//! it, how many stand before the chosen light sample, and where their number changes.
//!
//! With a_k the corners from the view-sample, e_k = a_k+1 - a_k, n_k = a_k x e_k and w = N . a_0, a light sample at s is in the
//! pyramid of the caster when w (n_k . s) >= 0 for k = 0, 1, 2, as in [`crate::shared::predicate`]. Over the ball of radius R about
//! the light's middle m, n_k . s is within |n_k| R of n_k . m.
//!
//! Bounds, in cell units, with u = 2^-24, H the distance in which corners and view-samples are and E the caster's size, lengths as sums of
//! absolute coordinates: a_k errs by 4 u H, e_k by 4 u E, n_k by 16 u H E with what the product rounds, n_k . s by 32 u H E |s|, and
//! the ball's range by as much again for a ball that does not hold the view-sample. w errs by 16 u |N| H.

use super::LANES;
use super::cell::{Block, Cell};
use crate::shared::predicate;
use crate::shared::soft::Soft;
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x16, mask32x16};

/// A view-sample in its cell's unit.
pub struct View {
    /// World space.
    pub position: [f32; 3],
    /// The chosen light sample.
    pub sample: usize,
    /// From the cell's origin.
    pub place: [f32; 3],
    /// From the view-sample to the light's middle.
    pub middle: [f32; 3],
    /// From the view-sample to the chosen light sample.
    pub chosen: [f32; 3],
    /// Along `middle`, of length one but for rounding.
    axis: [f32; 3],
    /// A little more than the tangent of half the angle in which the light's ball is seen.
    slope: f32,
    pub radius_square: f32,
    pub middle_reach: f32,
    pub chosen_reach: f32,
    /// Bound on its distance from the origin.
    reach: f32,
}

impl View {
    /// Of `position`, with light sample `sample` chosen.
    pub fn new(cell: &Cell, soft: &Soft, position: [f32; 3], sample: usize) -> Self {
        let to = |point: [f32; 3]| {
            let along = |k: usize| ((f64::from(point[k]) - f64::from(position[k])) * cell.scale) as f32;
            [along(0), along(1), along(2)]
        };
        let size = |v: [f32; 3]| v[0].abs() + v[1].abs() + v[2].abs();
        let (middle, chosen) = (to(soft.light.middle), to(soft.light.samples[sample]));
        let radius = (soft.light.radius * cell.scale) as f32;
        let length = (middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]).sqrt();
        Self {
            position,
            sample,
            place: cell.local(position),
            middle,
            chosen,
            axis: middle.map(|x| x / length),
            slope: 1.001 * radius / (length * length - radius * radius).max(0.0).sqrt() + 1e-5,
            reach: cell.views_reach,
            radius_square: radius * radius * (1.0 + 1e-4),
            middle_reach: size(middle) + radius,
            chosen_reach: size(chosen),
        }
    }
}

/// What a view-sample has met.
#[derive(Default)]
pub struct Met {
    /// By edge of the cell: its jump, where it is not zero or is `touched`.
    pub jump: Vec<i32>,
    /// Edges, some more than once, that a caster of `near` may have across the light: the first `touched_count`.
    touched: Vec<u32>,
    touched_count: usize,
    /// Edges with a jump, and it.
    pub changes: Vec<(u32, i32)>,
    /// Slots of casters that may hide a part of the light.
    pub near: Vec<u32>,
    /// Slots of those of which it is not sure whether they hide the chosen light sample.
    pub doubtful: Vec<u32>,
    /// Casters that surely hide the chosen light sample.
    pub count: u32,
}

/// Sixteen casters.
pub struct Answer {
    /// w is surely above zero, surely below zero.
    pub facing: [u16; 2],
    /// Wholly beside the light's cone.
    pub beyond: u16,
    /// None of the light is in the pyramid.
    pub beside: u16,
    /// By edge: its plane may cut the light.
    cut: [u16; 3],
    /// The chosen light sample is surely in the pyramid, surely outside.
    pub chosen: [u16; 2],
}

#[inline(always)]
pub fn cross<S: Simd>(a: [f32x16<S>; 3], b: [f32x16<S>; 3]) -> [f32x16<S>; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub fn dot<S: Simd>(a: [f32x16<S>; 3], b: [f32; 3]) -> f32x16<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn bits<S: Simd>(mask: mask32x16<S>) -> u16 {
    mask.to_bitmask() as u16
}

/// Which of the point sets `sets`, each a point and steps to the next, are surely wholly beside the cone to the light: beyond the plane that
/// touches its ball where it is nearest to the first point. `reach` bounds their distance from the cell's origin.
#[inline(always)]
pub fn beside<S: Simd, const N: usize>(
    simd: S,
    view: &View,
    from: [f32x16<S>; 3],
    steps: [[f32x16<S>; 3]; N],
    reach: f32x16<S>,
) -> u16 {
    let [x, y, z] = view.axis.map(|x| f32x16::splat(simd, x));
    let along = dot(from, view.axis);
    let square = from[0] * from[0] + from[1] * from[1] + from[2] * from[2];
    let across = (square - along * along).max(f32x16::splat(simd, 0.0)).sqrt();
    let back = along + across * view.slope;
    let normal = [from[0] - x * back, from[1] - y * back, from[2] - z * back];
    // The light's ball is on the other side: whatever rounding did to the normal.
    let size = normal[0].abs() + normal[1].abs() + normal[2].abs();
    let light = dot(normal, view.middle) + size * (1e-6 * view.middle_reach);
    let length = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    let is_light_behind = light.simd_lt(0.0) & (light * light).simd_gt(length * view.radius_square);
    let mut height = from[0] * normal[0] + from[1] * normal[1] + from[2] * normal[2];
    let mut least = height;
    for step in steps {
        height += step[0] * normal[0] + step[1] * normal[1] + step[2] * normal[2];
        least = least.min(height);
    }
    bits(is_light_behind & least.simd_gt((reach + view.reach) * size * 1e-6))
}

/// What each caster of `block` does to `view`, if any of `live` is not beside the light's cone.
#[inline(always)]
pub fn answer<S: Simd>(simd: S, block: &Block, live: u16, view: &View) -> Option<Answer> {
    let row = |row: &[f32; LANES]| f32x16::from_slice(simd, row);
    let corner = [
        row(&block.corner[0]) - view.place[0],
        row(&block.corner[1]) - view.place[1],
        row(&block.corner[2]) - view.place[2],
    ];
    let first = [row(&block.first[0]), row(&block.first[1]), row(&block.first[2])];
    let second = [row(&block.second[0]), row(&block.second[1]), row(&block.second[2])];
    let beside = beside(simd, view, corner, [first, second], row(&block.reach));
    if live & !beside == 0 {
        return None;
    }
    let normal = [row(&block.normal[0]), row(&block.normal[1]), row(&block.normal[2])];
    let w = normal[0] * corner[0] + normal[1] * corner[1] + normal[2] * corner[2];
    let facing_slack = row(&block.facing_slack);
    let is_above = w.simd_gt(facing_slack);
    let facing = [bits(is_above), bits(w.simd_lt(-facing_slack))];
    let turn = is_above.select(f32x16::splat(simd, 1.0), f32x16::splat(simd, -1.0));
    let slack = row(&block.slack);
    let (middle_slack, chosen_slack) = (slack * view.middle_reach, slack * view.chosen_reach);
    let next = [corner[0] + first[0], corner[1] + first[1], corner[2] + first[2]];
    let last = [next[0] + second[0], next[1] + second[1], next[2] + second[2]];
    let third = [-(first[0] + second[0]), -(first[1] + second[1]), -(first[2] + second[2])];
    let zero = f32x16::splat(simd, 0.0);
    let mut answer = Answer { facing, beyond: beside, beside, cut: [0; 3], chosen: [u16::MAX, 0] };
    macro_rules! edge {
        ($k:expr, $from:expr, $line:expr) => {
            let plane = cross($from, $line);
            let value = dot(plane, view.middle) * turn;
            let chosen = dot(plane, view.chosen) * turn;
            let square = plane[0] * plane[0] + plane[1] * plane[1] + plane[2] * plane[2];
            let far = (value.abs() - middle_slack).max(zero);
            let apart = bits((far * far).simd_gt(square * view.radius_square));
            answer.cut[$k] = !apart;
            answer.beside |= apart & bits(value.simd_lt(zero));
            answer.chosen[0] &= bits(chosen.simd_gt(chosen_slack));
            answer.chosen[1] |= bits(chosen.simd_lt(-chosen_slack));
        };
    }
    edge!(0, corner, first);
    edge!(1, next, second);
    edge!(2, last, third);
    Some(answer)
}

impl Met {
    /// Forgets the last view-sample; `edges` are in the cell.
    pub fn clear(&mut self, edges: usize) {
        self.sum_up();
        if self.jump.len() < edges {
            self.jump.resize(edges, 0);
        }
        self.near.clear();
        self.doubtful.clear();
        self.count = 0;
    }

    /// Meets the casters of `cell` that are `live` and not `joined`; whether one of them hides the whole light.
    #[inline(always)]
    pub fn meet<S: Simd>(
        &mut self,
        simd: S,
        soft: &Soft,
        cell: &Cell,
        live: &[u16],
        joined: &[u16],
        view: &View,
    ) -> bool {
        for (at, (live, joined)) in live.iter().zip(joined).enumerate() {
            let live = live & !joined;
            if live == 0 {
                continue;
            }
            let answer = simd.vectorize(
                #[inline(always)]
                || answer(simd, &cell.blocks[at], live, view),
            );
            let Some(answer) = answer else { continue };
            let sure = answer.facing[0] | answer.facing[1];
            let mut near = live & sure & !answer.beside;
            let [cut_0, cut_1, cut_2] = answer.cut;
            if near & !cut_0 & !cut_1 & !cut_2 != 0 {
                return true;
            }
            self.count += (near & answer.chosen[0]).count_ones();
            let mut doubtful = near & !answer.chosen[0] & !answer.chosen[1];
            while doubtful != 0 {
                self.doubtful.push((LANES * at) as u32 + doubtful.trailing_zeros());
                doubtful &= doubtful - 1;
            }
            while near != 0 {
                let lane = near.trailing_zeros();
                near &= near - 1;
                let facing = if answer.facing[0] >> lane & 1 == 1 { 1 } else { -1 };
                let cut = [cut_0 >> lane & 1 == 1, cut_1 >> lane & 1 == 1, cut_2 >> lane & 1 == 1];
                self.enter(cell, (LANES * at) as u32 + lane, facing, cut);
            }
            let mut flat = live & !sure & !answer.beyond;
            while flat != 0 {
                let slot = (LANES * at) as u32 + flat.trailing_zeros();
                flat &= flat - 1;
                let caster = &soft.triangles[cell.slots[slot as usize].triangle as usize];
                match predicate::side(caster, view.position) {
                    0 => {}
                    facing => {
                        self.doubtful.push(slot);
                        self.enter(cell, slot, facing, [true; 3]);
                    }
                }
            }
        }
        false
    }

    /// A caster of `facing` with the edges `cut` across the light.
    #[inline(always)]
    fn enter(&mut self, cell: &Cell, slot: u32, facing: i32, cut: [bool; 3]) {
        self.near.push(slot);
        let edges = cell.slots[slot as usize].edges;
        for k in 0..3 {
            let jump = if edges[k].is_multiple_of(2) { facing } else { -facing };
            self.touch(edges[k] / 2, jump, cut[k]);
        }
    }

    /// Adds `jump` to `edge` if it `is_cut`: without a branch, for nothing predicts it.
    #[inline(always)]
    pub fn touch(&mut self, edge: u32, jump: i32, is_cut: bool) {
        if self.touched_count == self.touched.len() {
            self.touched.resize(2 * self.touched_count + 64, 0);
        }
        self.jump[edge as usize] += if is_cut { jump } else { 0 };
        self.touched[self.touched_count] = edge;
        self.touched_count += usize::from(is_cut);
    }

    /// Moves the jumps that are not zero to `changes`; the sum of their sizes.
    #[inline(always)]
    pub fn sum_up(&mut self) -> u32 {
        self.changes.clear();
        self.changes.resize(self.touched_count, (0, 0));
        let (mut count, mut sum) = (0, 0);
        for edge in &self.touched[..self.touched_count] {
            let jump = std::mem::take(&mut self.jump[*edge as usize]);
            self.changes[count] = (*edge, jump);
            count += usize::from(jump != 0);
            sum += jump.unsigned_abs();
        }
        self.changes.truncate(count);
        self.touched_count = 0;
        sum
    }
}
