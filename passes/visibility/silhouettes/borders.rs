//! Casters of one facing for a whole cell, joined: only the edges where they end matter to its view-samples.
//!
//! A caster is joined when its plane leaves all view-samples of the cell on one side and every own plane of the cell lets it through. Edges
//! at which the joined casters balance are then dropped for the whole cell. What is left are borders, each with its jump.
//!
//! Joined casters that balance at an edge make a **sheet**. A sheet that has no border across a view-sample's light and one of whose casters
//! stands before the chosen light sample stands before all of them, whatever layers there are behind it.

use super::LANES;
use super::cell::Cell;
use super::meet::{View, bits};
use crate::shared::soft::Soft;
use fearless_simd::{Simd, SimdBase, f32x16};

/// Sixteen borders from the cell's origin, by lane.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Block {
    /// The lesser end.
    pub(super) from: [[f32; LANES]; 3],
    /// From the lesser end to the other.
    pub(super) line: [[f32; LANES]; 3],
    /// `from` x `line`.
    pub(super) plane: [[f32; LANES]; 3],
    /// `plane` . the chosen light sample.
    pub(super) chosen: [f32; LANES],
    /// As that of casters.
    pub(super) slack: [f32; LANES],
    pub(super) reach: [f32; LANES],
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
pub(super) const SLACK: f32 = 4e-6;

/// An edge where joined casters end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Border {
    pub(super) edge: u32,
    /// Up to two sheets that end there, and the jump of each; zero: none.
    pub(super) sheets: [(u32, i32); 2],
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
    pub(super) blocks: Vec<Block>,
    pub(super) borders: Vec<Border>,
    /// By slot: a slot of the same sheet nearer to the one that names it.
    sheet: Vec<u32>,
    /// By slot that names a sheet: its number.
    number: Vec<u32>,
    /// By edge: the last slot that nothing balances yet, its jump, and the place in `more` of the one before it.
    open: Vec<(u32, i32, u32)>,
    /// Slots that nothing balances yet, of the jump of the last one of their edge, and the place of the one before.
    more: Vec<(u32, u32)>,
    /// By sheet: casters before the chosen light sample, at the origin and at the view-sample at hand.
    pub(super) count: Vec<i32>,
    pub(super) now: Vec<i32>,
    /// By sheet: whether a border may be across the light.
    pub(super) is_cut: Vec<bool>,
    /// The chosen light sample from the origin.
    pub(super) chosen: [f32; 3],
    pub(super) chosen_reach: f32,
}

pub(super) fn size([x, y, z]: [f32; 3]) -> f32 {
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
        self.open.resize(cell.ends.len(), (NONE, 0, NONE));
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
        let limit = SHARE * count as f32;
        self.list(limit);
        if count == 0 || self.borders.len() as f32 > limit || !self.count_from_origin(simd, soft, cell, chosen) {
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
            let (other, of_other, before) = self.open[edge as usize / 2];
            self.open[edge as usize / 2] = if other == NONE {
                (slot, jump, NONE)
            } else if of_other == jump {
                self.more.push((other, before));
                (slot, jump, self.more.len() as u32 - 1)
            } else {
                let (a, b) = (self.root(other), self.root(slot));
                self.sheet[a.max(b) as usize] = a.min(b);
                match self.more.get(before as usize) {
                    Some(&(waiting, before)) => (waiting, of_other, before),
                    None => (NONE, 0, NONE),
                }
            };
        }
    }

    /// Lists what is left open, in the order of edges and two sheets to a border; stops past `limit`.
    fn list(&mut self, limit: f32) {
        for (edge, &(mut slot, jump, mut before)) in (0u32..).zip(&self.open) {
            let mut is_even = true;
            while slot != NONE {
                if self.borders.len() as f32 > limit {
                    return;
                }
                match self.borders.last_mut() {
                    Some(last) if !is_even => last.sheets[1] = (slot, jump),
                    _ => self.borders.push(Border { edge, sheets: [(slot, jump), (0, 0)] }),
                }
                is_even = !is_even;
                (slot, before) = self.more.get(before as usize).copied().unwrap_or((NONE, NONE));
            }
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
