//! View-samples in list order, sixteen at a time, with a blocked bit each: what casters are tested against.
//!
//! Texels of a row are neighbours in the list table, so a span of a row is one run of entries. A run is tested in whole chunks of
//! sixteen; a neighbour tested with it gets the answer it would get anyway. Faces start new chunks, for a chunk's coordinates
//! are those of one face. The kernel throws out what is surely outside; what is left is settled one by one, in f64 and where
//! that is in doubt by the exact predicate.

use super::hard::{OwnMemo, Scene};
use super::light_frame::Face;
use super::pair_counts::PairCounts;
use super::predicate::Pyramid;
use super::prefetch::prefetch;
use super::pyramid::{Cone, LightSpace, Planes, Reach, Spot};
use super::receiver_tree::{self, Trees};
use fearless_simd::{Level, Simd, SimdBase, SimdMask, dispatch, f32x16, u32x16};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU16, Ordering::Relaxed};

/// Nothing reached.
const EMPTY: [[f32; 2]; 2] = [[f32::MAX, f32::MIN]; 2];

/// Chunks between asking for a view-sample's memory and using it.
const AHEAD: usize = 6;

/// View-samples of a chunk.
pub const LANES: usize = 16;

/// Coordinates of sixteen view-samples of one face.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Chunk {
    /// Tangents along axis x.
    pub u: [f32; LANES],
    /// Tangents along axis y.
    pub v: [f32; LANES],
    /// Reciprocal depths.
    pub q: [f32; LANES],
}

/// One face's part of the table.
#[derive(Clone, Copy, Debug)]
pub struct FaceRange {
    /// World to light space.
    pub space: LightSpace,
    /// What to add to a list offset of this face for a place in the table.
    pub shift: usize,
    /// First and last but one place.
    pub places: [usize; 2],
    /// Smallest and largest u, then v; crossed over when the face has no view-samples that are projected.
    pub reach: [[f32; 2]; 2],
}

/// All listed view-samples.
pub struct Receivers<'a> {
    /// Coordinates; place i is lane i % 16 of chunk i / 16.
    pub chunks: Vec<Chunk>,
    /// Triangles that the view-samples lie on, by place.
    pub own: Vec<[u32; LANES]>,
    /// Bit set: blocked, or nobody is there. One word a chunk.
    pub blocked: Vec<AtomicU16>,
    /// View-samples by list offset; long lists are put in order.
    pub entries: Cow<'a, [u32]>,
    /// Parts by face.
    pub faces: Vec<FaceRange>,
    /// View-samples that cannot be projected with a bound; their bits in `blocked` are set, and they are to be tested one by one.
    pub wild: Vec<u32>,
    /// Long lists.
    pub trees: Trees,
}

/// What testing a run of places came to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tested {
    /// View-samples newly blocked.
    pub hits: u32,
    /// Whether any had been open.
    pub open: bool,
}

impl<'a> Receivers<'a> {
    /// Largest |u| and |v| on `face`, at least zero.
    pub fn extent(&self, face: usize) -> [f64; 2] {
        self.faces[face].reach.map(|[low, high]| if low > high { 0.0 } else { f64::from(low.abs().max(high.abs())) })
    }

    /// Places the view-samples of `entries` (cells in order, `cell_count` a face, bounded by `offsets`).
    pub fn gather(scene: &Scene, faces: &[Face], cell_count: usize, offsets: &[u32], entries: &'a [u32]) -> Self {
        let mut ranges: Vec<FaceRange> = Vec::with_capacity(faces.len());
        let mut places = 0;
        for (index, face) in faces.iter().enumerate() {
            let (start, end) = (offsets[index * cell_count] as usize, offsets[(index + 1) * cell_count] as usize);
            let ends = [places, places + end - start];
            ranges.push(FaceRange { space: LightSpace::new(face), shift: places - start, places: ends, reach: EMPTY });
            places = ends[1].next_multiple_of(LANES);
        }
        let long = receiver_tree::long_lists(offsets);
        let places_of = |cell: usize| {
            let shift = ranges[cell / cell_count].shift;
            [cell, cell + 1].map(|at| offsets[at] as usize + shift)
        };
        let long: Vec<(usize, [usize; 2])> = long.into_iter().map(|cell| (cell, places_of(cell))).collect();
        let mut entries = Cow::Borrowed(entries);
        if !long.is_empty() {
            put_in_order(entries.to_mut(), &long, &ranges, cell_count, scene);
        }
        let mut receivers = Self {
            chunks: vec![Chunk::default(); places / LANES],
            own: vec![[0; LANES]; places / LANES],
            blocked: Vec::new(),
            entries,
            faces: ranges,
            wild: Vec::new(),
            trees: Trees::default(),
        };
        receivers.blocked.resize_with(places / LANES, AtomicU16::default);
        for face in 0..faces.len() {
            receivers.place_face(scene, face);
        }
        receivers.wild.sort_unstable();
        receivers.trees = Trees::new(&receivers, &long);
        receivers
    }

    /// Fills the chunks of `face`.
    fn place_face(&mut self, scene: &Scene, face: usize) {
        let FaceRange { space, shift, places: [start, end], .. } = self.faces[face];
        let span = start / LANES..end.div_ceil(LANES);
        let wild = Mutex::new(Vec::new());
        let level = Level::new();
        let entries = &self.entries[start - shift..end - shift];
        let reached = (&mut self.chunks[span.clone()], &mut self.own[span.clone()], &mut self.blocked[span])
            .into_par_iter()
            .zip(entries.par_chunks(LANES))
            .enumerate()
            .with_min_len(256)
            .fold(Reached::default, |mut reached, (index, ((chunk, own, blocked), list))| {
                for sample in entries.iter().skip((index + AHEAD) * LANES).take(LANES) {
                    prefetch(&scene.position[*sample as usize]);
                    prefetch(&scene.triangle[*sample as usize]);
                }
                let missing = u16::MAX.checked_shl(list.len() as u32).unwrap_or(0);
                let mut positions = [[0.0; LANES]; 3];
                for (lane, sample) in list.iter().enumerate() {
                    own[lane] = scene.triangle[*sample as usize];
                    let position = scene.position[*sample as usize];
                    for axis in 0..3 {
                        positions[axis][lane] = position[axis];
                    }
                }
                let lost = dispatch!(level, simd => place(simd, &space, &positions, chunk)) | missing;
                *blocked.get_mut() = lost;
                reached.add(chunk, lost);
                if lost != missing
                    && let Ok(mut wild) = wild.lock()
                {
                    let lanes = (0..list.len()).filter(|lane| lost >> lane & 1 == 1);
                    wild.extend(lanes.map(|lane| list[lane]));
                }
                reached
            })
            .reduce(Reached::default, Reached::union);
        self.faces[face].reach = reached.ends();
        self.wild.extend(wild.into_inner().unwrap_or_default());
    }

    /// Coordinates of the view-sample at `place`; none when it is blocked, or nobody is there.
    pub fn spot(&self, place: usize) -> Option<Spot> {
        let (chunk, lane) = (&self.chunks[place / LANES], place % LANES);
        let open = self.blocked[place / LANES].load(Relaxed) >> lane & 1 == 0;
        open.then(|| Spot { u: chunk.u[lane], v: chunk.v[lane], q: chunk.q[lane] })
    }

    /// Tests the places `[from, to)` against a caster: `planes` by the kernel, `settle` for what the kernel leaves.
    #[inline(always)]
    pub fn test_run<S: Simd>(&self, simd: S, [from, to]: [usize; 2], planes: &Planes, settle: &mut Settle) -> Tested {
        let mut tested = Tested::default();
        if from >= to {
            return tested;
        }
        let (first, last) = (from / LANES, (to - 1) / LANES);
        let mut lanes = u16::MAX << (from % LANES);
        let mut pairs = 0;
        for index in first..=last {
            if index == last {
                lanes &= u16::MAX >> (LANES - 1 - (to - 1) % LANES);
            }
            let open = !self.blocked[index].load(Relaxed) & lanes;
            lanes = u16::MAX;
            if open == 0 {
                continue;
            }
            tested.open = true;
            pairs += open.count_ones();
            let mut left = candidates(simd, planes, &self.chunks[index]) & open;
            if left != 0 {
                left &= !lying_on(simd, settle.caster, &self.own[index]);
            }
            if left != 0 {
                tested.hits += settle.chunk(self, index, left);
            }
        }
        settle.counts.tested += u64::from(pairs);
        tested
    }
}

/// Puts the lists of `long` cells in order.
fn put_in_order(
    entries: &mut [u32],
    long: &[(usize, [usize; 2])],
    ranges: &[FaceRange],
    cell_count: usize,
    scene: &Scene,
) {
    let mut rest = entries;
    let mut taken = 0;
    let mut lists = Vec::with_capacity(long.len());
    for (cell, places) in long {
        let range = &ranges[cell / cell_count];
        let (_, from_here) = rest.split_at_mut(places[0] - range.shift - taken);
        let (list, behind) = from_here.split_at_mut(places[1] - places[0]);
        taken = places[1] - range.shift;
        rest = behind;
        lists.push((list, places[0], &range.space));
    }
    lists.into_par_iter().for_each(|(list, from, space)| receiver_tree::order(list, from, space, scene.position));
}

/// A caster whose candidates are to be settled, with where it stands.
pub struct Settle<'a> {
    scene: &'a Scene<'a>,
    face: &'a FaceRange,
    caster: u32,
    /// Its planes in f64 once known; none inside where only the exact predicate can tell.
    cone: Option<Option<Cone>>,
    memo: OwnMemo,
    /// What was met so far.
    pub counts: PairCounts,
}

impl<'a> Settle<'a> {
    /// For `caster` on `face`. `cone` if it is at hand: none inside where only the exact predicate can tell.
    pub fn new(scene: &'a Scene<'a>, face: &'a FaceRange, caster: u32, cone: Option<Option<Cone>>) -> Self {
        Self { scene, face, caster, cone, memo: OwnMemo::default(), counts: PairCounts::default() }
    }

    /// What to add to a list offset for a place.
    #[inline(always)]
    pub fn shift(&self) -> usize {
        self.face.shift
    }

    /// Settles the candidates `left` of a chunk and marks the blocked ones; how many are new.
    #[inline(never)]
    fn chunk(&mut self, receivers: &Receivers, index: usize, mut left: u16) -> u32 {
        let corners = &self.scene.triangles[self.caster as usize];
        let chunk = &receivers.chunks[index];
        let cone = *self.cone.get_or_insert_with(|| match self.face.space.reach(corners) {
            Reach::Cone(cone) => Some(cone),
            Reach::Nothing | Reach::Anything => None,
        });
        let mut hits = 0;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let sample = receivers.entries[index * LANES + lane - self.face.shift] as usize;
            let own = receivers.own[index][lane];
            let spot = Spot { u: chunk.u[lane], v: chunk.v[lane], q: chunk.q[lane] };
            let covers = match cone.and_then(|cone| cone.covers(&spot)) {
                Some(false) => false,
                Some(true) => self.scene.admits(&mut self.memo, own, corners),
                None => {
                    self.counts.exact += 1;
                    self.scene.admits(&mut self.memo, own, corners)
                        && Pyramid::new(corners, self.scene.light).covers(self.scene.position[sample])
                }
            };
            hits |= u16::from(covers) << lane;
        }
        if hits == 0 {
            return 0;
        }
        // The only writers are these; they set bits that no order can change.
        let new = (hits & !receivers.blocked[index].fetch_or(hits, Relaxed)).count_ones();
        self.counts.blocking += u64::from(new);
        new
    }
}

/// Lanes that are not surely outside, as [`Planes::may_cover`] says for each.
#[inline(always)]
pub fn candidates<S: Simd>(simd: S, planes: &Planes, chunk: &Chunk) -> u16 {
    let u = f32x16::from_slice(simd, &chunk.u);
    let v = f32x16::from_slice(simd, &chunk.v);
    let q = f32x16::from_slice(simd, &chunk.q);
    let value = |k: usize| u * planes.u[k] + v * planes.v[k] + planes.one[k];
    let inside = value(0).min(value(1)).min(value(2).min(value(3) + q * planes.q));
    inside.simd_ge(0.0).to_bitmask() as u16
}

/// Lanes whose view-samples lie on triangle `caster`: a triangle does not block them, whatever rounding says.
#[inline(always)]
fn lying_on<S: Simd>(simd: S, caster: u32, own: &[u32; LANES]) -> u16 {
    u32x16::from_slice(simd, own).simd_eq(caster).to_bitmask() as u16
}

/// Projects sixteen positions into `chunk`; the lanes that are wild.
#[inline(always)]
fn place<S: Simd>(_: S, space: &LightSpace, positions: &[[f32; LANES]; 3], chunk: &mut Chunk) -> u16 {
    let mut tame = [0u16; LANES];
    for lane in 0..LANES {
        let (spot, is_tame) = space.project([positions[0][lane], positions[1][lane], positions[2][lane]]);
        (chunk.u[lane], chunk.v[lane], chunk.q[lane]) = (spot.u, spot.v, spot.q);
        tame[lane] = u16::from(is_tame) << lane;
    }
    !tame.iter().fold(0, |all, bit| all | bit)
}

/// Smallest and largest coordinates so far, lane by lane.
#[derive(Clone, Copy)]
struct Reached {
    low: [[f32; LANES]; 2],
    high: [[f32; LANES]; 2],
}

impl Default for Reached {
    fn default() -> Self {
        Self { low: [[f32::MAX; LANES]; 2], high: [[f32::MIN; LANES]; 2] }
    }
}

impl Reached {
    #[inline(always)]
    fn add(&mut self, chunk: &Chunk, lost: u16) {
        for (axis, along) in [&chunk.u, &chunk.v].into_iter().enumerate() {
            for (lane, at) in along.iter().enumerate() {
                let here = lost >> lane & 1 == 0;
                self.low[axis][lane] = self.low[axis][lane].min(if here { *at } else { f32::MAX });
                self.high[axis][lane] = self.high[axis][lane].max(if here { *at } else { f32::MIN });
            }
        }
    }

    fn union(mut self, other: Self) -> Self {
        for axis in 0..2 {
            for lane in 0..LANES {
                self.low[axis][lane] = self.low[axis][lane].min(other.low[axis][lane]);
                self.high[axis][lane] = self.high[axis][lane].max(other.high[axis][lane]);
            }
        }
        self
    }

    /// Smallest and largest u, then v.
    fn ends(self) -> [[f32; 2]; 2] {
        [0, 1].map(|axis| {
            let low = self.low[axis].iter().fold(f32::MAX, |a, b| a.min(*b));
            [low, self.high[axis].iter().fold(f32::MIN, |a, b| a.max(*b))]
        })
    }
}

#[cfg(test)]
#[path = "receivers_tests.rs"]
mod tests;
