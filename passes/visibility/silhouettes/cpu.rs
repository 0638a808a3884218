//! Cells in parallel, view-sample by view-sample.

use super::LANES;
use super::borders::Borders;
use super::cell::Cell;
use super::count::Counters;
use super::edges::Edges;
use super::meet::{Met, View};
use super::own::Run;
use crate::ports;
use crate::shared::atomic_words::into_words;
use crate::shared::light_box::LightBox;
use crate::shared::light_sides::{Sides, sides};
use crate::shared::predicate::Pyramid;
use crate::shared::soft::{Pair, Soft};
use crate::shared::view_planes::{Hidden, Planes, hidden};
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, KEPT, NO_CELL};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// View-samples that one task takes at most.
const TASK: usize = 1024;
/// Choices of a light sample to count from before a view-sample is left to single tests.
const CHOICES: usize = 3;

/// What was counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Casters gathered, by cell.
    pub gathered: u64,
    /// Borders of joined casters, by cell.
    pub borders: u64,
    /// (view-sample, kind of light sample) for which joined casters were counted one by one.
    pub recounted: u64,
    /// Those of them that may hide a part of the light.
    pub near: u64,
    /// (view-sample, edge) whose jump was added.
    pub crossing: u64,
    /// View-samples decided without an edge.
    pub whole: u64,
    /// View-samples decided by counting.
    pub counted: u64,
    /// View-samples left to single tests.
    pub left: u64,
    /// (view-sample, caster) tested singly.
    pub single: u64,
    /// (view-sample, light sample) in doubt, and (view-sample, caster, light sample) of single tests.
    pub exact: u64,
}

impl Counts {
    fn plus(self, other: Self) -> Self {
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
struct Worker<'a> {
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
    counts: Counts,
}

/// Whether nothing about a caster keeps it from having edges.
fn is_finite(corners: &[[f32; 3]; 3]) -> bool {
    corners.as_flattened().iter().all(|x| x.is_finite())
}

/// The edges of all casters of `soft`.
pub fn edges_of(soft: &Soft) -> Edges {
    Edges::new(soft.triangles, |id| soft.caster_state[id] != 0 && is_finite(&soft.triangles[id]))
}

/// Masks `[P ceil(L/32)]` on instruction set `level`, with the edges of all casters.
pub fn masks(soft: &Soft, edges: &Edges, level: Level, progress: &(dyn Fn(u64, u64) + Sync)) -> (Vec<u32>, Counts) {
    let words = soft.light.words();
    let base = |row: usize| match soft.sample_state[row / words] {
        BACKGROUND | KEPT => 0,
        _ => u32::MAX,
    };
    let masks: Vec<AtomicU32> = (0..soft.position.len() * words)
        .into_par_iter()
        .with_min_len(1 << 14)
        .map(|row| AtomicU32::new(base(row)))
        .collect();
    if words == 0 {
        return (into_words(masks), Counts::default());
    }
    let casts = |id: usize| soft.caster_state[id] != 0;
    let everyone: Vec<u32> = (0..soft.triangles.len()).filter(|id| casts(*id)).map(|id| id as u32).collect();
    let unlisted: Vec<u32> = (0..soft.position.len() as u32)
        .filter(|row| soft.sample_state[*row as usize] == KEPT && soft.cell[*row as usize] == NO_CELL)
        .collect();
    let choices = choices(&soft.light);
    let by_cell = soft.listed.chunk_by(|a, b| soft.cell[*a as usize] == soft.cell[*b as usize]);
    let tasks: Vec<(&[u32], bool)> = by_cell
        .flat_map(|rows| rows.chunks(TASK))
        .map(|rows| (rows, true))
        .chain(unlisted.chunks(TASK).map(|rows| (rows, false)))
        .collect();
    let (done, total) = (AtomicU64::new(0), (soft.listed.len() + unlisted.len()) as u64);
    let counts = tasks
        .par_iter()
        .map_init(
            || Worker::new(soft, edges, &choices),
            |worker, (rows, listed)| {
                worker.counts = Counts::default();
                let casters = if *listed { soft.casters_of(rows[0] as usize) } else { &everyone };
                dispatch!(level, simd => worker.cell(simd, rows, casters, &masks));
                let count = rows.len() as u64;
                progress(done.fetch_add(count, Relaxed) + count, total);
                worker.counts
            },
        )
        .reduce(Counts::default, Counts::plus);
    (into_words(masks), counts)
}

/// The light sample nearest the middle, and others.
fn choices(light: &LightBox) -> Vec<usize> {
    let distance = |at: &usize| {
        let sample = light.samples[*at];
        (0..3).map(|k| (f64::from(sample[k]) - f64::from(light.middle[k])).powi(2)).sum::<f64>()
    };
    let count = light.samples.len();
    let nearest = (0..count).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
    (0..CHOICES.min(count)).map(|k| (nearest + k * count / CHOICES) % count).collect()
}

impl<'a> Worker<'a> {
    fn new(soft: &'a Soft<'a>, edges: &'a Edges, choices: &'a [usize]) -> Self {
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

    /// The view-samples `rows` of a cell with `casters`.
    #[inline(always)]
    fn cell<S: Simd>(&mut self, simd: S, rows: &[u32], casters: &[u32], masks: &[AtomicU32]) {
        let soft = self.soft;
        if casters.is_empty() {
            return;
        }
        self.rows.clear();
        self.rows.extend_from_slice(rows);
        // View-samples of one triangle together: its plane lets the same casters through.
        self.rows.sort_unstable_by_key(|row| (soft.triangle[*row as usize], *row));
        let views: Vec<[f32; 3]> = self.rows.iter().map(|row| soft.position[*row as usize]).collect();
        self.cell.turn_to(&views, &soft.light, soft.triangles, self.edges, casters);
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
        self.borders.join(simd, soft, &self.cell, self.edges, &self.always, self.choices[0]);
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
            self.single(simd, row, run, self.cell.singles[at]);
        }
    }

    /// Fills the mask of `row` for the light samples of `kind`.
    #[inline(always)]
    fn kind<S: Simd>(&mut self, simd: S, row: usize, run: usize, kind: usize) {
        let soft = self.soft;
        let position = soft.position[row];
        for &chosen in self.choices {
            let view = View::new(&self.cell, soft, position, chosen);
            let live = self.runs[run].live(kind);
            self.met.clear(self.cell.edges.len());
            if self.met.meet(simd, soft, &self.cell, live, &self.borders.joined, &view) {
                self.counts.whole += 1;
                for word in 0..self.mask.len() {
                    self.mask[word] |= self.runs[run].allowed(soft, kind, word);
                }
                return;
            }
            self.counts.near += self.met.near.len() as u64;
            let mut joined = Some(0);
            if self.borders.is_used {
                joined = self.borders.meet(simd, &view, &mut self.met);
                if joined.is_none() || chosen != self.choices[0] {
                    self.counts.recounted += 1;
                    joined = self.borders.count_at(simd, soft, &self.cell, &view, chosen);
                }
            }
            let Some(joined) = joined else { continue };
            let before = self.counters.crossing;
            let Self { counters, met, cell, edges, .. } = self;
            if counters.count(simd, soft, cell, edges, met, position, chosen, joined).is_err() {
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
            if self.runs[run].live(kind)[at / LANES] >> (at % LANES) & 1 == 1 {
                self.single(simd, row, run, self.cell.slots[at].triangle);
            }
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

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let soft = Soft::new(cx, LightBox::clustered(cx.input(input::LIGHT_SAMPLES.name).as_vec3()));
    let (mask, counts) = masks(&soft, &edges_of(&soft), Level::new(), cx.progress());
    cx.put(ports::MASK.name, Array::u32([soft.position.len(), soft.light.words()], mask));
    cx.count("gathered", counts.gathered);
    cx.count("borders", counts.borders);
    cx.count("recounted", counts.recounted);
    cx.count("near", counts.near);
    cx.count("crossing", counts.crossing);
    cx.count("whole_rows", counts.whole);
    cx.count("counted_rows", counts.counted);
    cx.count("left_rows", counts.left);
    cx.count("single", counts.single);
    cx.count("exact", counts.exact);
    Ok(())
}
