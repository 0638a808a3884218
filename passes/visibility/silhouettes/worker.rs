//! A cell, view-sample by view-sample.

use super::LANES;
use super::ask::Joined;
use super::borders::Borders;
use super::cell::Cell;
use super::count::Counters;
use super::edges::Edges;
use super::meet::{Met, View};
use super::own::Run;
use crate::shared::light_sides::{Sides, sides};
use crate::shared::predicate::Pyramid;
use crate::shared::soft::{Pair, Soft};
use crate::shared::view_planes::{Hidden, Planes, hidden};
use fearless_simd::Simd;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// View-samples that share what is found out about casters once.
const PART: usize = 32;

/// What was counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Casters gathered, by part of a cell.
    pub gathered: u64,
    /// Borders of joined casters, by part of a cell.
    pub borders: u64,
    /// (row, chosen light sample) for which joined casters were counted one by one. A row is a view-sample with one kind of light
    /// sample, of which there are several where its own plane cuts the light.
    pub recounted: u64,
    /// (row, caster), not of joined casters, in which the caster may hide a part of the light.
    pub near: u64,
    /// (row, edge) whose jump was added.
    pub crossing: u64,
    /// Rows decided without an edge.
    pub whole: u64,
    /// Rows decided by counting.
    pub counted: u64,
    /// Rows left to single tests.
    pub left: u64,
    /// (view-sample, caster) tested singly.
    pub single: u64,
    /// (view-sample, light sample) in doubt, and (view-sample, caster, light sample) of single tests.
    pub exact: u64,
}

impl Counts {
    /// Both.
    pub fn plus(self, other: Self) -> Self {
        Self {
            gathered: self.gathered + other.gathered,
            borders: self.borders + other.borders,
            recounted: self.recounted + other.recounted,
            near: self.near + other.near,
            crossing: self.crossing + other.crossing,
            whole: self.whole + other.whole,
            counted: self.counted + other.counted,
            left: self.left + other.left,
            single: self.single + other.single,
            exact: self.exact + other.exact,
        }
    }
}

/// What one thread keeps.
pub struct Worker<'a> {
    soft: &'a Soft<'a>,
    edges: &'a Edges,
    /// Light samples to count from, the best first.
    choices: &'a [usize],
    cell: Cell,
    /// By own triangle of the cell.
    runs: Vec<Run>,
    /// By block: casters that every one of them lets through.
    always: Vec<u16>,
    borders: Borders,
    met: Met,
    counters: Counters,
    mask: Vec<u32>,
    restored: Vec<u32>,
    rows: Vec<u32>,
    /// Since they were last reset.
    pub counts: Counts,
}

/// Sorts `rows` to both sides of the middle of their box's longest side; how many are before it. None for few.
fn split(soft: &Soft, rows: &mut [u32]) -> Option<usize> {
    if rows.len() <= PART {
        return None;
    }
    let at = |row: &u32, axis: usize| soft.position[*row as usize][axis];
    let ends = |axis: usize| {
        rows.iter().fold([f32::MAX, f32::MIN], |[low, high], row| [low.min(at(row, axis)), high.max(at(row, axis))])
    };
    let ends = [ends(0), ends(1), ends(2)];
    let axis = (0..3).max_by(|a, b| (ends[*a][1] - ends[*a][0]).total_cmp(&(ends[*b][1] - ends[*b][0])))?;
    let middle = 0.5 * ends[axis][0] + 0.5 * ends[axis][1];
    rows.sort_unstable_by_key(|row| (at(row, axis) > middle, *row));
    let before = rows.partition_point(|row| at(row, axis) <= middle);
    (before > 0 && before < rows.len()).then_some(before)
}

impl<'a> Worker<'a> {
    /// For the first cell.
    pub fn new(soft: &'a Soft<'a>, edges: &'a Edges, choices: &'a [usize]) -> Self {
        let words = soft.light.words();
        Self {
            soft,
            edges,
            choices,
            cell: Cell::new(edges.ends.len()),
            runs: Vec::new(),
            always: Vec::new(),
            borders: Borders::default(),
            met: Met::default(),
            counters: Counters::default(),
            mask: vec![0; words],
            restored: vec![0; words],
            rows: Vec::new(),
            counts: Counts::default(),
        }
    }

    /// The view-samples `rows` of a cell with `casters`, in parts that lie close together: a caster's facing is then that of a part.
    #[inline(always)]
    pub fn cell<S: Simd>(&mut self, simd: S, rows: &[u32], casters: &[u32], masks: &[AtomicU32]) {
        if casters.is_empty() {
            return;
        }
        let mut rows = rows.to_vec();
        let mut left: Vec<&mut [u32]> = vec![&mut rows];
        while let Some(rows) = left.pop() {
            match split(self.soft, rows) {
                Some(at) => {
                    let (low, high) = rows.split_at_mut(at);
                    left.extend([low, high]);
                }
                None => self.part(simd, rows, casters, masks),
            }
        }
    }

    /// The view-samples `rows` with `casters`.
    #[inline(always)]
    fn part<S: Simd>(&mut self, simd: S, rows: &[u32], casters: &[u32], masks: &[AtomicU32]) {
        let soft = self.soft;
        self.rows.clear();
        self.rows.extend_from_slice(rows);
        // View-samples of one triangle together: its plane lets the same casters through.
        self.rows.sort_unstable_by_key(|row| (soft.triangle[*row as usize], *row));
        let views: Vec<[f32; 3]> = self.rows.iter().map(|row| soft.position[*row as usize]).collect();
        simd.vectorize(
            #[inline(always)]
            || self.cell.turn_to(&views, &soft.light, soft.triangles, self.edges, casters),
        );
        self.counts.gathered += self.cell.slots.len() as u64;
        self.prepare(simd);
        let (mut run, mut own) = (0, soft.triangle[self.rows[0] as usize]);
        for at in 0..self.rows.len() {
            let row = self.rows[at] as usize;
            if soft.triangle[row] != own {
                (run, own) = (run + 1, soft.triangle[row]);
            }
            self.mask.fill(0);
            self.row(simd, row, run);
            self.restored.fill(0);
            soft.light.restore(&self.mask, &mut self.restored);
            let words = self.mask.len();
            for (word, mask) in self.restored.iter().enumerate() {
                // Each view-sample is listed once, so no two threads meet here.
                masks[row * words + word].store(*mask, Relaxed);
            }
        }
    }

    /// What each own triangle lets through, and what is joined.
    #[inline(always)]
    fn prepare<S: Simd>(&mut self, simd: S) {
        let soft = self.soft;
        self.always.clear();
        self.always.extend((0..self.cell.blocks.len()).map(|at| self.cell.lanes(at)));
        let mut count = 0;
        for at in 0..self.rows.len() {
            let own = soft.triangle[self.rows[at] as usize];
            if at > 0 && own == soft.triangle[self.rows[at - 1] as usize] {
                continue;
            }
            if self.runs.len() == count {
                self.runs.push(Run::new(soft));
            }
            let run = &mut self.runs[count];
            count += 1;
            run.turn_to(simd, soft, &self.cell, own);
            for kind in 0..run.kinds() {
                self.always.iter_mut().zip(run.live(kind)).for_each(|(always, live)| *always &= live);
            }
        }
        self.borders.join(simd, soft, &self.cell, &self.always, self.choices[0]);
        self.counts.borders += self.borders.len() as u64;
    }

    /// Fills the mask of view-sample `row`, whose own triangle is the one of `run`.
    #[inline(always)]
    fn row<S: Simd>(&mut self, simd: S, row: usize, run: usize) {
        if !self.cell.slots.is_empty() {
            for kind in 0..self.runs[run].kinds() {
                self.kind(simd, row, run, kind);
            }
        }
        for at in 0..self.cell.singles.len() {
            if self.is_full() {
                return;
            }
            self.single(simd, row, run, self.cell.singles[at]);
        }
    }

    /// Whether every light sample is hidden.
    fn is_full(&self) -> bool {
        self.mask.iter().enumerate().all(|(word, mask)| self.soft.light.used(word) & !mask == 0)
    }

    /// Fills the mask of `row` for the light samples of `kind`.
    #[inline(always)]
    fn kind<S: Simd>(&mut self, simd: S, row: usize, run: usize, kind: usize) {
        let soft = self.soft;
        let position = soft.position[row];
        for &chosen in self.choices {
            let view = View::new(&self.cell, soft, position, chosen);
            self.met.clear(self.cell.ends.len());
            let mut joined = 0;
            if self.borders.is_used {
                match self.borders.meet(simd, &view, &mut self.met) {
                    Joined::Covers if chosen == self.choices[0] => return self.fill(run, kind),
                    Joined::Count(count) if chosen == self.choices[0] => joined = count,
                    _ => {
                        self.counts.recounted += 1;
                        let tell = |_| joined += 1;
                        if self.borders.count_at(simd, soft, &self.cell, &view, tell).is_none() {
                            continue;
                        }
                    }
                }
            }
            let live = self.runs[run].live(kind);
            if self.met.meet(simd, soft, &self.cell, live, &self.borders.joined, &view) {
                return self.fill(run, kind);
            }
            self.counts.near += self.met.near.len() as u64;
            let before = self.counters.crossing;
            let Self { counters, met, cell, .. } = self;
            if counters.count(simd, soft, cell, met, &view, joined).is_err() {
                continue;
            }
            let crossing = self.counters.crossing - before;
            self.counts.crossing += crossing;
            *(if crossing == 0 { &mut self.counts.whole } else { &mut self.counts.counted }) += 1;
            for word in 0..self.mask.len() {
                let allowed = self.runs[run].allowed(soft, kind, word);
                let doubts = self.counters.doubts[word] & allowed;
                let blocked = self.counters.blocked(word) & allowed & !doubts;
                self.mask[word] |= blocked | self.decide(position, word, doubts);
            }
            return;
        }
        self.counts.left += 1;
        for at in 0..self.cell.slots.len() {
            if self.is_full() {
                return;
            }
            if self.runs[run].live(kind)[at / LANES] >> (at % LANES) & 1 == 1 {
                self.single(simd, row, run, self.cell.slots[at].triangle);
            }
        }
    }

    /// All light samples of `kind` are hidden.
    fn fill(&mut self, run: usize, kind: usize) {
        self.counts.whole += 1;
        for word in 0..self.mask.len() {
            self.mask[word] |= self.runs[run].allowed(self.soft, kind, word);
        }
    }

    /// The light samples `doubts` of `word` that a caster of those met hides.
    fn decide(&mut self, position: [f32; 3], word: usize, mut doubts: u32) -> u32 {
        let mut hidden = 0;
        while doubts != 0 {
            let bit = doubts.trailing_zeros();
            doubts &= doubts - 1;
            self.counts.exact += 1;
            let light = self.soft.light.samples[32 * word + bit as usize];
            let hides = |slot: &u32| {
                let triangle = self.cell.slots[*slot as usize].triangle;
                Pyramid::new(&self.soft.triangles[triangle as usize], light).covers(position)
            };
            let joined = (0..self.cell.slots.len() as u32)
                .filter(|slot| self.borders.joined[*slot as usize / LANES] >> (slot % LANES as u32) & 1 == 1);
            hidden |= u32::from(self.met.near.iter().any(hides) || joined.into_iter().any(|slot| hides(&slot))) << bit;
        }
        hidden
    }

    /// Adds what `caster` alone hides from `row`.
    #[inline(always)]
    fn single<S: Simd>(&mut self, simd: S, row: usize, run: usize, caster: u32) {
        let soft = self.soft;
        if caster == soft.triangle[row] {
            return;
        }
        self.counts.single += 1;
        let corners = &soft.triangles[caster as usize];
        let mut planes = Planes::EMPTY;
        let light = &soft.light;
        let mut ready = match hidden(corners, soft.position[row], light, &mut planes) {
            Hidden::Nothing => return,
            Hidden::All => None,
            Hidden::Within => Some(Sides::new(&planes, light)),
        };
        let mut pair = Pair { caster: corners, position: soft.position[row], light, exact: 0 };
        let mut on = None;
        for word in 0..self.mask.len() {
            let open = light.used(word) & !self.mask[word];
            if open == 0 {
                continue;
            }
            let mut bits = match &mut ready {
                Some(ready) => {
                    let [inside, doubtful] = sides(simd, ready, light, word);
                    inside | pair.decide(word, doubtful & open)
                }
                None => open,
            };
            if bits & open != 0 {
                let on = *on.get_or_insert_with(|| self.runs[run].sides.corners_on(soft, corners));
                bits &= self.runs[run].sides.admitted(on, word);
                self.mask[word] |= bits & open;
            }
        }
        self.counts.exact += pair.exact;
    }
}
