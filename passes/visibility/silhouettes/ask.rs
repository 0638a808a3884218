//! What the borders of a cell say of one view-sample: which of them may be across its light, and how many joined casters stand before
//! the chosen light sample.
//!
//! How many joined casters a segment to the chosen light sample c meets is counted once, from the cell's origin o. From there
//! to view-sample v it changes by the jumps of those borders that pass through the triangle (o, v, c): the edge from a to b does when
//! det(a, b, o, v), det(a, b, v, c) and det(a, b, c, o) agree in sign and a and b are on different sides of the triangle's plane. No joined
//! caster's plane is between o and v, and none reaches as far as the light: nothing else can change the number.

use super::LANES;
use super::borders::{Block, Borders, SLACK, size};
use super::cell::Cell;
use super::meet::{Met, View, answer, beside, bits, cross, dot};
use crate::shared::predicate;
use crate::shared::soft::Soft;
use fearless_simd::{Simd, SimdBase, f32x16};

/// What a view-sample's borders say.
pub enum Joined {
    /// A sheet hides all of the light.
    Covers,
    /// So many joined casters stand before the chosen light sample.
    Count(i32),
    /// A border may be at the way: they have to be counted one by one.
    Doubt,
}

impl Borders {
    /// Tells of each joined caster between `view` and its chosen light sample; none where that is on a border of one.
    #[inline(always)]
    pub fn count_at<S: Simd>(
        &self,
        simd: S,
        soft: &Soft,
        cell: &Cell,
        view: &View,
        mut tell: impl FnMut(u32),
    ) -> Option<()> {
        for (at, joined) in self.joined.iter().enumerate() {
            if *joined == 0 {
                continue;
            }
            let answer = simd.vectorize(
                #[inline(always)]
                || answer(simd, &cell.blocks[at], *joined, view),
            );
            let Some(answer) = answer else { continue };
            let sure = answer.facing[0] | answer.facing[1];
            let mut before = joined & sure & answer.chosen[0] & !answer.beside;
            while before != 0 {
                tell((LANES * at) as u32 + before.trailing_zeros());
                before &= before - 1;
            }
            let mut doubts = joined & !(sure & (answer.chosen[0] | answer.chosen[1] | answer.beside)) & !answer.beyond;
            while doubts != 0 {
                let slot = (LANES * at) as u32 + doubts.trailing_zeros();
                doubts &= doubts - 1;
                let caster = &soft.triangles[cell.slots[slot as usize].triangle as usize];
                if strictly(caster, view.position, soft.light.samples[view.sample])? {
                    tell(slot);
                }
            }
        }
        Some(())
    }

    /// Adds the borders that may be across the light to those met, and counts at the light sample that casters were joined for.
    #[inline(always)]
    pub fn meet<S: Simd>(&mut self, simd: S, view: &View, met: &mut Met) -> Joined {
        let mut is_sure = true;
        self.now.clear();
        self.now.extend_from_slice(&self.count);
        self.is_cut.clear();
        self.is_cut.resize(self.count.len(), false);
        let [q, c] = [view.place, self.chosen];
        let way = [q[1] * c[2] - q[2] * c[1], q[2] * c[0] - q[0] * c[2], q[0] * c[1] - q[1] * c[0]];
        let is_origin = q == [0.0; 3];
        for (at, block) in self.blocks.iter().enumerate() {
            let lanes = (self.borders.len() - LANES * at).min(LANES);
            let lanes = if lanes == LANES { u16::MAX } else { (1 << lanes) - 1 };
            let [touched, rise, fall, doubts] = simd.vectorize(
                #[inline(always)]
                || self.sides(simd, block, view, way),
            );
            let mut touched = touched & lanes;
            while touched != 0 {
                let border = self.borders[LANES * at + touched.trailing_zeros() as usize];
                touched &= touched - 1;
                met.touch(border.edge, border.sheets[0].1 + border.sheets[1].1, true);
                for (sheet, jump) in border.sheets {
                    self.is_cut[sheet as usize] |= jump != 0;
                }
            }
            if is_origin {
                continue;
            }
            is_sure &= doubts & lanes == 0;
            let mut crossed = (rise | fall) & lanes;
            while crossed != 0 {
                let lane = crossed.trailing_zeros() as usize;
                crossed &= crossed - 1;
                for (sheet, jump) in self.borders[LANES * at + lane].sheets {
                    self.now[sheet as usize] += if rise >> lane & 1 == 1 { jump } else { -jump };
                }
            }
        }
        if !is_sure {
            return Joined::Doubt;
        }
        let covers = |(count, is_cut): (&i32, &bool)| *count > 0 && !is_cut;
        if self.now.iter().zip(&self.is_cut).any(covers) {
            Joined::Covers
        } else {
            Joined::Count(self.now.iter().sum())
        }
    }

    /// Borders that may be across the light; through the way's triangle towards the side of c, and away from it; and those in doubt.
    #[inline(always)]
    fn sides<S: Simd>(&self, simd: S, block: &Block, view: &View, way: [f32; 3]) -> [u16; 4] {
        let row = |row: &[f32; LANES]| f32x16::from_slice(simd, row);
        let from = [row(&block.from[0]), row(&block.from[1]), row(&block.from[2])];
        let line = [row(&block.line[0]), row(&block.line[1]), row(&block.line[2])];
        let plane = [row(&block.plane[0]), row(&block.plane[1]), row(&block.plane[2])];
        let (slack, reach) = (row(&block.slack), row(&block.reach));
        let start = [from[0] - view.place[0], from[1] - view.place[1], from[2] - view.place[2]];
        let beside = beside(simd, view, start, [line], reach);
        let normal = cross(start, line);
        let value = dot(normal, view.middle);
        let square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
        let far = (value.abs() - slack * view.middle_reach).max(f32x16::splat(simd, 0.0));
        let apart = bits((far * far).simd_gt(square * view.radius_square));

        let signs = |value: f32x16<S>, slack: f32x16<S>| [bits(value.simd_gt(slack)), bits(value.simd_lt(-slack))];
        let near = size(view.place);
        let [a, c, e] = [
            signs(dot(plane, view.place), slack * near),
            signs(dot(normal, view.chosen), slack * view.chosen_reach),
            signs(-row(&block.chosen), slack * self.chosen_reach),
        ];
        let way_slack = reach * (SLACK * near * self.chosen_reach);
        let (at_from, step) = (dot(from, way), dot(line, way));
        let [f, t] = [signs(at_from, way_slack), signs(at_from + step, way_slack)];
        let through = f[0] & t[1] | f[1] & t[0];
        let (rise, fall) = (through & a[0] & c[0] & e[0], through & a[1] & c[1] & e[1]);
        let none = f[0] & t[0] | f[1] & t[1] | (a[0] | c[0] | e[0]) & (a[1] | c[1] | e[1]);
        [!apart & !beside, rise, fall, !(none | rise | fall)]
    }
}

/// Whether `caster` is between `position` and `light`; none where the segment meets its border.
pub fn strictly(caster: &predicate::Corners, position: [f32; 3], light: [f32; 3]) -> Option<bool> {
    let [a, b, c] = *caster;
    let w = predicate::side(caster, position);
    let signs = [[a, b], [b, c], [c, a]].map(|[from, to]| w * predicate::side(&[light, from, to], position));
    match signs.into_iter().min() {
        Some(0) => None,
        least => Some(least == Some(1)),
    }
}
