//! What the passes of soft visibility share: the walk over cells, view-samples and casters, own planes, and masks.
//!
//! Cells run in parallel. In each, every view-sample meets the casters that the cell lists until its mask is full. A view-sample that no
//! cell lists meets every casting triangle. How one caster's share of the light is found is the pass's own ([`PairTest`]).
//!
//! Where `penumbra_state` says that the whole light has one answer, one light sample is asked and answers for all.

use super::light_box::LightBox;
use super::predicate::{self, Corners};
use super::view_planes::{Hidden, Planes, hidden, side_of_light};
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::shared::{BACKGROUND, KEPT, NO_CELL, NO_TRIANGLE};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// View-samples that one task takes.
const TASK: usize = 256;

/// How a pass finds what one caster hides.
pub trait PairTest: Sync {
    /// What is made once a pair.
    type Ready;
    /// Prepares the planes of a pair.
    fn ready(&self, planes: &Planes, light: &LightBox) -> Self::Ready;
    /// The light samples of mask word `word` that the caster hides, among `open`.
    fn bits<S: Simd>(&self, simd: S, pair: &mut Pair, ready: &mut Self::Ready, word: usize, open: u32) -> u32;
}

/// One (view-sample, caster).
pub struct Pair<'a> {
    /// Corners.
    pub caster: &'a Corners,
    /// The view-sample.
    pub position: [f32; 3],
    /// The light.
    pub light: &'a LightBox<'a>,
    /// (view-sample, caster, light sample) decided by the exact predicate.
    pub exact: u64,
}

impl Pair<'_> {
    /// Decides the light samples `doubts` of word `word` exactly, own planes apart.
    #[inline(never)]
    pub fn decide(&mut self, word: usize, mut doubts: u32) -> u32 {
        let mut hidden = 0;
        while doubts != 0 {
            let bit = doubts.trailing_zeros();
            doubts &= doubts - 1;
            let light = self.light.samples[32 * word + bit as usize];
            self.exact += 1;
            hidden |= u32::from(predicate::Pyramid::new(self.caster, light).covers(self.position)) << bit;
        }
        hidden
    }
}

/// Inputs of a soft visibility pass.
#[derive(Clone)]
pub struct Soft<'a> {
    /// Corners of every triangle.
    pub triangles: &'a [Corners],
    /// 1 for each that casts.
    pub caster_state: &'a [u32],
    /// Position of every view-sample.
    pub position: &'a [[f32; 3]],
    /// Triangle of every view-sample.
    pub triangle: &'a [u32],
    /// State of every view-sample.
    pub sample_state: &'a [u32],
    /// Cell of every view-sample.
    pub cell: &'a [u32],
    /// View-samples by cell, all listed ones.
    pub listed: &'a [u32],
    /// Where a cell's casters start.
    pub caster_offset: &'a [u32],
    /// Casters by cell.
    pub caster_entries: &'a [u32],
    /// 0 for each view-sample to which the whole light has one answer; none: nothing is known.
    pub penumbra_state: Option<&'a [u32]>,
    /// Light samples.
    pub light: LightBox<'a>,
}

/// What was counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// (view-sample, caster) pairs that were met.
    pub pairs: u64,
    /// Those of them in which a plane of the caster may cut the light.
    pub cut_pairs: u64,
    /// (view-sample, caster, light sample) decided by the exact predicate.
    pub exact: u64,
}

impl Counts {
    fn plus(self, other: Self) -> Self {
        Self {
            pairs: self.pairs + other.pairs,
            cut_pairs: self.cut_pairs + other.cut_pairs,
            exact: self.exact + other.exact,
        }
    }
}

impl<'a> Soft<'a> {
    /// From the ports of stage `visibility`.
    /// `light` holds the light samples in the order in which the pass answers.
    pub fn new(cx: &CpuCx<'a>, light: LightBox<'a>) -> Self {
        let listed = cx.input("list_offset").as_u32().last().copied().unwrap_or(0) as usize;
        Self {
            triangles: bytemuck::cast_slice(cx.input("triangles").as_f32()),
            caster_state: cx.input("caster_state").as_u32(),
            position: cx.input("position").as_vec3(),
            triangle: cx.input("triangle").as_u32(),
            sample_state: cx.input("sample_state").as_u32(),
            cell: cx.input("cell").as_u32(),
            listed: &cx.input("list_entries").as_u32()[..listed],
            caster_offset: cx.input("caster_offset").as_u32(),
            caster_entries: cx.input("caster_entries").as_u32(),
            penumbra_state: cx.optional("penumbra_state").map(Array::as_u32),
            light,
        }
    }

    /// Masks `[P ceil(L/32)]` by `test`.
    pub fn masks(&self, test: &impl PairTest, progress: &(dyn Fn(u64, u64) + Sync)) -> (Array, Counts) {
        let words = self.light.words();
        let base = |row: usize| match self.sample_state[row / words] {
            BACKGROUND | KEPT => 0,
            _ => u32::MAX,
        };
        let masks: Vec<AtomicU32> = (0..self.position.len() * words)
            .into_par_iter()
            .with_min_len(1 << 14)
            .map(|row| AtomicU32::new(base(row)))
            .collect();
        let everyone: Vec<u32> =
            (0..self.triangles.len() as u32).filter(|id| self.caster_state[*id as usize] != 0).collect();
        let unlisted: Vec<u32> = (0..self.position.len() as u32)
            .filter(|row| self.sample_state[*row as usize] == KEPT && self.cell[*row as usize] == NO_CELL)
            .collect();
        let is_whole = |row: &u32| self.penumbra_state.is_some_and(|state| state[*row as usize] == 0);
        let (whole, partial): (Vec<u32>, Vec<u32>) = self.listed.iter().partition(|row| is_whole(row));
        // One light sample, the first, in place of all.
        let first = &self.light.samples[..self.light.samples.len().min(1)];
        let hard = Soft { light: LightBox::new(first), ..self.clone() };
        let level = Level::new();
        let (done, total) = (AtomicU64::new(0), (self.listed.len() + unlisted.len()) as u64);
        let tasks: Vec<(&[u32], Asked)> = [(&partial, Asked::Cell), (&whole, Asked::CellOnce), (&unlisted, Asked::All)]
            .into_iter()
            .flat_map(|(rows, asked)| rows.chunks(TASK).map(move |rows| (rows, asked)))
            .collect();
        let counts = tasks
            .par_iter()
            .map(|(rows, asked)| {
                let casters = |row: usize| if *asked == Asked::All { &everyone } else { self.casters_of(row) };
                // Each view-sample is in one task, so no two threads meet here.
                let put = |row: usize, mask: &[u32]| {
                    for (word, to) in masks[row * words..(row + 1) * words].iter().enumerate() {
                        let whole = if mask[0] == 0 { 0 } else { self.light.used(word) };
                        to.store(if *asked == Asked::CellOnce { whole } else { mask[word] }, Relaxed);
                    }
                };
                let mut walk = Walk::new(if *asked == Asked::CellOnce { &hard } else { self });
                dispatch!(level, simd => walk.rows(simd, test, rows, &casters, &put));
                let count = rows.len() as u64;
                progress(done.fetch_add(count, Relaxed) + count, total);
                walk.counts
            })
            .reduce(Counts::default, Counts::plus);
        let masks = masks.into_iter().map(AtomicU32::into_inner).collect();
        (Array::u32([self.position.len(), words], masks), counts)
    }

    /// Casters of the cell of view-sample `row`.
    pub fn casters_of(&self, row: usize) -> &[u32] {
        let cell = self.cell[row] as usize;
        &self.caster_entries[self.caster_offset[cell] as usize..self.caster_offset[cell + 1] as usize]
    }
}

/// Which casters a view-sample meets, and for how much of the light.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Asked {
    /// Those of its cell, for every light sample.
    Cell,
    /// Those of its cell, for one light sample.
    CellOnce,
    /// All, for every light sample.
    All,
}

/// What one thread keeps.
struct Walk<'a> {
    soft: &'a Soft<'a>,
    mask: Vec<u32>,
    /// The mask in the order of the light samples.
    restored: Vec<u32>,
    own: OwnSides,
    /// Of the pair at hand.
    planes: Planes,
    counts: Counts,
}

/// Which light samples are on which side of a triangle's plane, kept from one view-sample to the next: neighbours mostly lie on one.
pub struct OwnSides {
    own: u32,
    /// -1 or 1 where all of the light is on one side; 0 where `plus` and `minus` say.
    pub whole: i32,
    plus: Vec<u32>,
    minus: Vec<u32>,
}

impl OwnSides {
    /// Of no triangle yet.
    pub fn new(soft: &Soft) -> Self {
        let none = vec![0; soft.light.words()];
        Self { own: NO_TRIANGLE, whole: 0, plus: none.clone(), minus: none }
    }

    /// Turns to the plane of triangle `own`.
    pub fn turn_to(&mut self, soft: &Soft, own: u32) {
        if self.own == own {
            return;
        }
        self.own = own;
        let Some(corners) = soft.triangles.get(own as usize) else { return };
        self.whole = side_of_light(corners, &soft.light);
        if self.whole == 0 {
            self.plus.fill(0);
            self.minus.fill(0);
            for (place, sample) in soft.light.samples.iter().enumerate() {
                match predicate::side(corners, *sample) {
                    1 => self.plus[place / 32] |= 1 << (place % 32),
                    -1 => self.minus[place / 32] |= 1 << (place % 32),
                    _ => {}
                }
            }
        }
    }

    /// The sides of the own plane on which `caster` has a corner: towards minus, towards plus.
    pub fn corners_on(&self, soft: &Soft, caster: &Corners) -> [bool; 2] {
        let Some(own) = soft.triangles.get(self.own as usize) else { return [true; 2] };
        let sides = caster.map(|corner| predicate::side(own, corner));
        [sides.contains(&-1), sides.contains(&1)]
    }

    /// The light samples of word `word` that a caster with corners `on` these sides may shadow: the rule of
    /// [`predicate::OwnPlane`].
    #[inline(always)]
    pub fn admitted(&self, on: [bool; 2], word: usize) -> u32 {
        match self.whole {
            -1 => {
                if on[0] {
                    u32::MAX
                } else {
                    0
                }
            }
            1 => {
                if on[1] {
                    u32::MAX
                } else {
                    0
                }
            }
            _ if on == [true; 2] => u32::MAX,
            _ => {
                let (minus, plus) = (self.minus[word], self.plus[word]);
                !(minus | plus) | if on[0] { minus } else { 0 } | if on[1] { plus } else { 0 }
            }
        }
    }
}

impl<'a> Walk<'a> {
    fn new(soft: &'a Soft<'a>) -> Self {
        let none = vec![0; soft.light.words()];
        Self {
            soft,
            mask: none.clone(),
            restored: none,
            own: OwnSides::new(soft),
            planes: Planes::EMPTY,
            counts: Counts::default(),
        }
    }

    /// The view-samples `rows` against their casters; `put` takes the row and mask of each.
    #[inline(always)]
    fn rows<'b, S: Simd, T: PairTest>(
        &mut self,
        simd: S,
        test: &T,
        rows: &[u32],
        casters: &impl Fn(usize) -> &'b [u32],
        put: &impl Fn(usize, &[u32]),
    ) {
        for row in rows.iter().map(|row| *row as usize) {
            self.mask.fill(0);
            self.own.turn_to(self.soft, self.soft.triangle[row]);
            for caster in casters(row) {
                if self.pair(simd, test, row, *caster) {
                    break;
                }
            }
            self.restored.fill(0);
            self.soft.light.restore(&self.mask, &mut self.restored);
            put(row, &self.restored);
        }
    }

    /// View-sample `row` against `caster`; whether the mask is full.
    #[inline(always)]
    fn pair<S: Simd, T: PairTest>(&mut self, simd: S, test: &T, row: usize, caster: u32) -> bool {
        let soft = self.soft;
        if caster == soft.triangle[row] {
            return false;
        }
        self.counts.pairs += 1;
        let corners = &soft.triangles[caster as usize];
        let light = &soft.light;
        let mut ready = match hidden(corners, soft.position[row], light, &mut self.planes) {
            Hidden::Nothing => return false,
            Hidden::All => None,
            Hidden::Within => Some(test.ready(&self.planes, light)),
        };
        self.counts.cut_pairs += u64::from(ready.is_some());
        let mut pair = Pair { caster: corners, position: soft.position[row], light, exact: 0 };
        let (mut on, mut full) = (None, true);
        for word in 0..self.mask.len() {
            let open = light.used(word) & !self.mask[word];
            if open == 0 {
                continue;
            }
            let mut bits = match &mut ready {
                Some(ready) => test.bits(simd, &mut pair, ready, word, open) & open,
                None => open,
            };
            if bits != 0 {
                let on = *on.get_or_insert_with(|| self.own.corners_on(soft, corners));
                bits &= self.own.admitted(on, word);
                self.mask[word] |= bits;
            }
            full &= bits == open;
        }
        self.counts.exact += pair.exact;
        full
    }
}
