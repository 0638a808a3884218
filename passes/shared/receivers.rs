//! View-samples in list order, sixteen at a time, with a blocked bit each: what casters are tested against.
//!
//! Texels of a row are neighbours in the list table, so a span of a row is one run of entries. A run is tested in whole chunks of
//! sixteen; a neighbour tested with it gets the answer it would get anyway. Faces start new chunks, for a chunk's coordinates
//! are those of one face. The kernel throws out what is surely outside; what is left is settled one by one, in f64 and where
//! that is in doubt by the exact predicate.

use super::hard::{OwnMemo, Scene};
use super::light_frame::Face;
use super::predicate::Pyramid;
use super::pyramid::{Cone, LightSpace, Planes, Reach, Spot};
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16};
use rayon::prelude::*;
use shadowgraph_core::shared::NO_TRIANGLE;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU16, Ordering::Relaxed};

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

/// What a view-sample is known by outside its chunk.
#[derive(Clone, Copy, Debug)]
pub struct Receiver {
    /// Row of the view-sample.
    pub sample: u32,
    /// Triangle it lies on.
    pub own: u32,
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
pub struct Receivers {
    /// Coordinates; place i is lane i % 16 of chunk i / 16.
    pub chunks: Vec<Chunk>,
    /// Who is at each place.
    pub who: Vec<Receiver>,
    /// Bit set: blocked, or nobody is there. One word a chunk.
    pub blocked: Vec<AtomicU16>,
    /// Parts by face.
    pub faces: Vec<FaceRange>,
    /// View-samples that cannot be projected with a bound; their bits in `blocked` are set, and they are to be tested one by one.
    pub wild: Vec<u32>,
}

impl Receivers {
    /// Largest |u| and |v| on `face`, at least zero.
    pub fn extent(&self, face: usize) -> [f64; 2] {
        self.faces[face].reach.map(|[low, high]| if low > high { 0.0 } else { f64::from(low.abs().max(high.abs())) })
    }

    /// Places the view-samples of `entries` (cells in order, `cell_count` a face, bounded by `offsets`).
    pub fn gather(scene: &Scene, faces: &[Face], cell_count: usize, offsets: &[u32], entries: &[u32]) -> Self {
        let mut ranges = Vec::with_capacity(faces.len());
        let mut places = 0;
        for (index, face) in faces.iter().enumerate() {
            let (start, end) = (offsets[index * cell_count] as usize, offsets[(index + 1) * cell_count] as usize);
            let ends = [places, places + end - start];
            let empty = [[f32::MAX, f32::MIN]; 2];
            ranges.push(FaceRange { space: LightSpace::new(face), shift: places - start, places: ends, reach: empty });
            places = ends[1].next_multiple_of(LANES);
        }
        let mut chunks = vec![Chunk::default(); places / LANES];
        let mut who = vec![Receiver { sample: NO_TRIANGLE, own: NO_TRIANGLE }; places];
        let mut blocked: Vec<AtomicU16> = Vec::new();
        blocked.resize_with(chunks.len(), AtomicU16::default);
        let wild = Mutex::new(Vec::new());
        for range in &mut ranges {
            let [start, end] = range.places;
            let span = start / LANES..end.div_ceil(LANES);
            let list = &entries[start - range.shift..end - range.shift];
            let space = range.space;
            range.reach = (&mut chunks[span.clone()], &mut blocked[span.clone()])
                .into_par_iter()
                .zip(who[start..span.end * LANES].par_chunks_mut(LANES))
                .zip(list.par_chunks(LANES))
                .with_min_len(256)
                .map(|(((chunk, blocked), who), list)| {
                    let mut lost = u16::MAX;
                    for (lane, sample) in list.iter().enumerate() {
                        who[lane] = Receiver { sample: *sample, own: scene.triangle[*sample as usize] };
                        if let Some(spot) = space.spot(scene.position[*sample as usize]) {
                            (chunk.u[lane], chunk.v[lane], chunk.q[lane]) = (spot.u, spot.v, spot.q);
                            lost &= !(1 << lane);
                        } else if let Ok(mut wild) = wild.lock() {
                            wild.push(*sample);
                        }
                    }
                    *blocked.get_mut() = lost;
                    reach(chunk, !lost)
                })
                .reduce(|| [[f32::MAX, f32::MIN]; 2], union);
        }
        let mut wild = wild.into_inner().unwrap_or_default();
        wild.sort_unstable();
        Self { chunks, who, blocked, faces: ranges, wild }
    }

    /// Tests the chunk at `index` against a caster: `planes` by the kernel, `settle` for what the kernel leaves. `lanes` are
    /// those that matter. False when all of them were blocked already.
    #[inline(always)]
    pub fn test<S: Simd>(&self, simd: S, index: usize, lanes: u16, planes: &Planes, settle: &mut Settle) -> bool {
        let open = !self.blocked[index].load(Relaxed) & lanes;
        if open == 0 {
            return false;
        }
        let left = candidates(simd, planes, &self.chunks[index]) & open;
        if left != 0 {
            settle.chunk(self, index, left);
        }
        true
    }
}

/// A caster whose candidates are to be settled, with where it stands.
pub struct Settle<'a> {
    scene: &'a Scene<'a>,
    space: &'a LightSpace,
    caster: u32,
    /// Its planes in f64 once known; none inside where only the exact predicate can tell.
    cone: Option<Option<Cone>>,
    memo: OwnMemo,
    /// Pairs that went to the exact predicate.
    pub exact: u64,
}

impl<'a> Settle<'a> {
    /// For `caster` on the face of `space`. `cone` if it is at hand: none inside where only the exact predicate can tell.
    pub fn new(scene: &'a Scene<'a>, space: &'a LightSpace, caster: u32, cone: Option<Option<Cone>>) -> Self {
        Self { scene, space, caster, cone, memo: OwnMemo::default(), exact: 0 }
    }

    /// Settles the candidates `left` of a chunk and marks the blocked ones.
    #[inline(never)]
    fn chunk(&mut self, receivers: &Receivers, index: usize, mut left: u16) {
        let corners = &self.scene.triangles[self.caster as usize];
        let chunk = &receivers.chunks[index];
        let cone = *self.cone.get_or_insert_with(|| match self.space.reach(corners) {
            Reach::Cone(cone) => Some(cone),
            Reach::Nothing | Reach::Anything => None,
        });
        let mut hits = 0;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let receiver = receivers.who[index * LANES + lane];
            if receiver.own == self.caster {
                continue;
            }
            let spot = Spot { u: chunk.u[lane], v: chunk.v[lane], q: chunk.q[lane] };
            let covers = match cone.and_then(|cone| cone.covers(&spot)) {
                Some(false) => false,
                Some(true) => self.scene.admits(&mut self.memo, receiver.own, corners),
                None => {
                    self.exact += 1;
                    self.scene.admits(&mut self.memo, receiver.own, corners)
                        && Pyramid::new(corners, self.scene.light).covers(self.scene.position[receiver.sample as usize])
                }
            };
            hits |= u16::from(covers) << lane;
        }
        if hits != 0 {
            // The only writers are these; they set bits that no order can change.
            receivers.blocked[index].fetch_or(hits, Relaxed);
        }
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

/// Smallest and largest u, then v, of the lanes in `lanes`.
fn reach(chunk: &Chunk, lanes: u16) -> [[f32; 2]; 2] {
    let mut ends = [[f32::MAX, f32::MIN]; 2];
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
        for (ends, at) in ends.iter_mut().zip([chunk.u[lane], chunk.v[lane]]) {
            *ends = [ends[0].min(at), ends[1].max(at)];
        }
    }
    ends
}

fn union(a: [[f32; 2]; 2], b: [[f32; 2]; 2]) -> [[f32; 2]; 2] {
    [0, 1].map(|axis| [a[axis][0].min(b[axis][0]), a[axis][1].max(b[axis][1])])
}

#[cfg(test)]
#[path = "receivers_tests.rs"]
mod tests;
