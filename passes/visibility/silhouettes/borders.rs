//! Casters of one facing for a whole cell, joined: only the edges where they end matter to its view-samples.
//!
//! A caster is joined when its plane leaves all view-samples of the cell on one side and every own plane of the cell lets it through. Edges
//! at which the joined casters balance are then dropped for the whole cell. What is left are borders, each with its jump.
//!
//! Joined casters that balance at an edge make a **sheet**. A sheet that has no border across a view-sample's light and one of whose casters
//! stands before the chosen light sample stands before all of them, whatever layers there are behind it.
//!
//! How many joined casters a segment to the chosen light sample c meets is counted once, from the cell's origin o. From there
//! to view-sample v it changes by the jumps of those borders that pass through the triangle (o, v, c): the edge from a to b does when
//! det(a, b, o, v), det(a, b, v, c) and det(a, b, c, o) agree in sign and a and b are on different sides of the triangle's plane. No joined
//! caster's plane is between o and v, and none reaches as far as the light: nothing else can change the number.

use super::LANES;
use super::cell::Cell;
use super::meet::{Met, View, answer, beside, bits, cross, dot};
use crate::shared::predicate;
use crate::shared::soft::Soft;
use fearless_simd::{Simd, SimdBase, f32x16};

/// Sixteen borders from the cell's origin, by lane.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Block {
    /// The lesser end.
    from: [[f32; LANES]; 3],
    /// From the lesser end to the other.
    line: [[f32; LANES]; 3],
    /// `from` x `line`.
    plane: [[f32; LANES]; 3],
    /// `plane` . the chosen light sample.
    chosen: [f32; LANES],
    /// As that of casters.
    slack: [f32; LANES],
    reach: [f32; LANES],
}

const EMPTY: Block = Block {
    from: [[0.0; LANES]; 3],
    line: [[0.0; LANES]; 3],
    plane: [[0.0; LANES]; 3],
    chosen: [0.0; LANES],
    slack: [0.0; LANES],
    reach: [0.0; LANES],
};

/// Borders are worth while where they are fewer than this share of the casters that they stand for.
const SHARE: f32 = 0.75;
/// As in `cell`.
const SLACK: f32 = 4e-6;

/// An edge where joined casters end.
#[derive(Clone, Copy, Debug)]
struct Border {
    edge: u32,
    /// Up to two sheets that end there, and the jump of each; zero: none.
    sheets: [(u32, i32); 2],
}

/// No caster.
const NONE: u32 = u32::MAX;

/// The joined casters of a cell.
#[derive(Default)]
pub struct Borders {
    /// By block of casters: those that are joined.
    pub joined: Vec<u16>,
    /// Whether any caster is joined.
    pub is_used: bool,
    blocks: Vec<Block>,
    borders: Vec<Border>,
    /// By slot: a slot of the same sheet nearer to the one that names it.
    sheet: Vec<u32>,
    /// By slot that names a sheet: its number.
    number: Vec<u32>,
    /// By edge: a slot that nothing balances yet, its jump, and whether `more` may hold others.
    open: Vec<(u32, i32, bool)>,
    /// More of the same edge.
    more: Vec<(u32, u32, i32)>,
    /// By sheet: casters before the chosen light sample, at the origin and at the view-sample at hand.
    count: Vec<i32>,
    now: Vec<i32>,
    /// By sheet: whether a border may be across the light.
    is_cut: Vec<bool>,
    /// The chosen light sample from the origin.
    chosen: [f32; 3],
    chosen_reach: f32,
}

/// What a view-sample's borders say.
pub enum Joined {
    /// A sheet hides all of the light.
    Covers,
    /// So many joined casters stand before the chosen light sample.
    Count(i32),
    /// A border may be at the way: they have to be counted one by one.
    Doubt,
}

fn size([x, y, z]: [f32; 3]) -> f32 {
    x.abs() + y.abs() + z.abs()
}

impl Borders {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.borders.len()
    }

    /// Joins casters of `cell` among those that are `always` let through, to be counted at light sample `chosen`.
    #[inline(always)]
    pub fn join<S: Simd>(&mut self, simd: S, soft: &Soft, cell: &Cell, always: &[u16], chosen: usize) {
        self.is_used = false;
        self.blocks.clear();
        self.borders.clear();
        self.joined.clear();
        self.more.clear();
        self.open.clear();
        self.open.resize(cell.ends.len(), (NONE, 0, false));
        self.sheet.clear();
        self.sheet.extend(0..cell.slots.len() as u32);
        let [low, high] = cell.views;
        let middle = [0, 1, 2].map(|k| 0.5 * low[k] + 0.5 * high[k]);
        // Rounding of the middle is less than what is added.
        let half = [0, 1, 2].map(|k| (high[k] - middle[k]).max(middle[k] - low[k]) + 1e-6 * cell.views_reach);
        let mut count = 0;
        for (at, always) in always.iter().enumerate() {
            let facing = simd.vectorize(
                #[inline(always)]
                || facing(simd, cell, at, middle, half),
            );
            let joined = (facing[0] | facing[1]) & always;
            self.joined.push(joined);
            count += joined.count_ones();
            let mut left = joined;
            while left != 0 {
                let lane = left.trailing_zeros();
                left &= left - 1;
                let facing = if facing[0] >> lane & 1 == 1 { 1 } else { -1 };
                self.balance(cell, (LANES * at) as u32 + lane, facing);
            }
        }
        for (edge, &(slot, jump, _)) in (0u32..).zip(&self.open) {
            if slot != NONE {
                self.borders.push(Border { edge, sheets: [(slot, jump), (0, 0)] });
            }
        }
        for &(edge, slot, jump) in &self.more {
            // In the order of edges: the lists above are.
            let at = self.borders.partition_point(|border| border.edge < edge);
            match self.borders.get_mut(at) {
                Some(border) if border.edge == edge && border.sheets[1].1 == 0 => border.sheets[1] = (slot, jump),
                _ => self.borders.insert(at, Border { edge, sheets: [(slot, jump), (0, 0)] }),
            }
        }
        if count == 0
            || self.borders.len() as f32 > SHARE * count as f32
            || !self.count_from_origin(simd, soft, cell, chosen)
        {
            self.joined.fill(0);
            self.borders.clear();
            return;
        }
        self.is_used = true;
        self.chosen = cell.local(soft.light.samples[chosen]);
        self.chosen_reach = size(self.chosen);
        for at in 0..self.borders.len() {
            for k in 0..2 {
                let (slot, jump) = self.borders[at].sheets[k];
                self.borders[at].sheets[k] = if jump == 0 { (0, 0) } else { (self.number_of(slot), jump) };
            }
            self.push(cell, at);
        }
    }

    /// Enters caster `slot` at its edges: two that balance are of one sheet.
    #[inline(always)]
    fn balance(&mut self, cell: &Cell, slot: u32, facing: i32) {
        for edge in cell.slots[slot as usize].edges {
            let jump = if edge % 2 == 0 { facing } else { -facing };
            let (other, of_other, is_more) = self.open[edge as usize / 2];
            if other == NONE || of_other == jump {
                if other != NONE {
                    self.more.push((edge / 2, other, of_other));
                }
                self.open[edge as usize / 2] = (slot, jump, is_more || other != NONE);
                continue;
            }
            let (a, b) = (self.root(other), self.root(slot));
            self.sheet[a.max(b) as usize] = a.min(b);
            // Another that was waiting takes its place.
            let waiting = if is_more { self.more.iter().position(|(waiting, ..)| *waiting == edge / 2) } else { None };
            self.open[edge as usize / 2] = match waiting.map(|at| self.more.swap_remove(at)) {
                Some((_, slot, jump)) => (slot, jump, true),
                None => (NONE, 0, false),
            };
        }
    }

    /// The number of the sheet of `slot`, a new one with no caster before the light sample if it has none.
    fn number_of(&mut self, slot: u32) -> u32 {
        let root = self.root(slot) as usize;
        if self.number[root] == NONE {
            self.number[root] = self.count.len() as u32;
            self.count.push(0);
        }
        self.number[root]
    }

    fn root(&mut self, mut at: u32) -> u32 {
        while self.sheet[at as usize] != at {
            let up = self.sheet[self.sheet[at as usize] as usize];
            self.sheet[at as usize] = up;
            at = up;
        }
        at
    }

    fn push(&mut self, cell: &Cell, at: usize) {
        let lane = at % LANES;
        if lane == 0 {
            self.blocks.push(EMPTY);
        }
        let Some(block) = self.blocks.last_mut() else { return };
        let [a, b] = cell.ends[self.borders[at].edge as usize];
        let from = cell.local(a);
        let line = [0, 1, 2].map(|k| ((f64::from(b[k]) - f64::from(a[k])) * cell.scale) as f32);
        let plane = [
            from[1] * line[2] - from[2] * line[1],
            from[2] * line[0] - from[0] * line[2],
            from[0] * line[1] - from[1] * line[0],
        ];
        let reach = size(from) + size(line);
        for k in 0..3 {
            (block.from[k][lane], block.line[k][lane], block.plane[k][lane]) = (from[k], line[k], plane[k]);
        }
        block.chosen[lane] = plane[0] * self.chosen[0] + plane[1] * self.chosen[1] + plane[2] * self.chosen[2];
        block.slack[lane] = SLACK * (reach + cell.views_reach) * size(line);
        block.reach[lane] = reach;
    }

    /// Counts at the cell's origin; whether it is sure.
    #[inline(always)]
    fn count_from_origin<S: Simd>(&mut self, simd: S, soft: &Soft, cell: &Cell, chosen: usize) -> bool {
        let view = View::new(cell, soft, cell.origin, chosen);
        let mut before = Vec::new();
        let is_sure = self.count_at(simd, soft, cell, &view, |slot| before.push(slot)).is_some();
        self.count.clear();
        self.number.clear();
        self.number.resize(cell.slots.len(), NONE);
        for slot in before {
            let sheet = self.number_of(slot);
            self.count[sheet as usize] += 1;
        }
        is_sure
    }

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

/// Casters of block `at` whose plane is surely below all view-samples of the cell, and those whose plane is above.
#[inline(always)]
fn facing<S: Simd>(simd: S, cell: &Cell, at: usize, middle: [f32; 3], half: [f32; 3]) -> [u16; 2] {
    let block = &cell.blocks[at];
    let row = |row: &[f32; LANES]| f32x16::from_slice(simd, row);
    let normal = [row(&block.normal[0]), row(&block.normal[1]), row(&block.normal[2])];
    let w = (row(&block.corner[0]) - middle[0]) * normal[0]
        + (row(&block.corner[1]) - middle[1]) * normal[1]
        + (row(&block.corner[2]) - middle[2]) * normal[2];
    let spread = normal[0].abs() * half[0] + normal[1].abs() * half[1] + normal[2].abs() * half[2];
    let width = spread * (1.0 + 1e-6) + row(&block.facing_slack);
    [bits(w.simd_gt(width)), bits(w.simd_lt(-width))]
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
