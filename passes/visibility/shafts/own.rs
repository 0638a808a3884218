//! The own triangles of a cluster's view-samples, and which casters they let through.
//!
//! A caster with no corner strictly above the plane of the triangle that a view-sample lies on, on the light sample's side, cannot
//! block there ([`crate::shared::predicate`]), and no triangle blocks points of itself. Bounds over all planes of the cluster
//! settle most casters at once; what is left is looked at plane by plane, in doubt exactly, once for the cluster.

use super::candidates::Candidates;
use super::groups::{Blocks, Frame, dot, size};
use super::plane::{ABOVE, BELOW, Plane, Rows};
use super::{LANES, MOST_VIEWS, lanes_from};
use crate::shared::predicate::Corners;
use fearless_simd::Simd;
use std::collections::HashMap;

/// Planes of a cluster that every caster is held against at once; with more, only where it matters.
const SOON: usize = 4;

/// What the planes make of a caster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No view-sample lies on it, and every plane lets it through for every light sample.
    Plain,
    /// It blocks nothing here.
    Never,
    /// Look at row `.0`.
    Mixed(u32),
    /// Not looked at yet: [`OwnPlanes::judge_each`] tells.
    Open,
}

/// For how many light samples a view-sample's own triangle lets a caster through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Admits {
    /// All.
    All,
    /// None.
    None,
    /// Those that [`OwnPlanes::allowed_lights`] tells.
    Some,
}

/// A set of a cluster's planes, of which there are at most as many as view-samples.
type Set = [u64; MOST_VIEWS / 64];

/// Own planes of a group of view-samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Owners {
    planes: Set,
    /// Whether some view-sample lies on no triangle.
    free: bool,
}

/// What each plane makes of a caster.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    above: Set,
    below: Set,
    /// Planes that let it through for every light sample.
    plain: Set,
    /// Planes that hold it back for every light sample: those of the caster itself among them.
    never: Set,
}

fn has(set: &Set, at: u16) -> bool {
    set[usize::from(at) / 64] >> (at % 64) & 1 == 1
}

fn put(set: &mut Set, at: usize) {
    set[at / 64] |= 1 << (at % 64);
}

/// Sixteen of a set.
fn part(set: &Set, first: usize) -> u16 {
    (set[first / 64] >> (first % 64)) as u16
}

fn put_part(set: &mut Set, first: usize, part: u16) {
    set[first / 64] |= u64::from(part) << (first % 64);
}

fn is_within(small: &Set, large: &Set) -> bool {
    (0..small.len()).all(|word| small[word] & !large[word] == 0)
}

/// All own triangles of a cluster.
#[derive(Default)]
pub struct OwnPlanes {
    planes: Vec<Plane>,
    by_lanes: Rows,
    /// Planes that all light samples are above of for certain, and those that are certain.
    all_lit: Set,
    all_certain: Set,
    /// Plane of each view-sample, by place; `NONE` when it lies on no triangle.
    of_view: Vec<u16>,
    rows: Vec<Row>,
    mean: [f32; 3],
    spread: f32,
    /// Smallest and largest constants with the bounds of their errors.
    constant: [f32; 2],
    error: f32,
    size: f32,
    lit: bool,
    certain: bool,
    /// Whether every view-sample lies on a triangle.
    complete: bool,
    known: HashMap<u64, u8>,
}

const NONE: u16 = u16::MAX;

/// What does not change from cluster to cluster.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// All triangles, as they came.
    pub triangles: &'a [Corners],
    /// All light samples, as they came.
    pub lights: &'a [[f32; 3]],
    /// From world to unit lengths.
    pub scale: f64,
}

impl World<'_> {
    /// A point in unit lengths.
    #[inline(always)]
    pub fn unit(&self, p: [f32; 3]) -> [f32; 3] {
        p.map(|x| (f64::from(x) * self.scale) as f32)
    }
}

impl OwnPlanes {
    /// Those of view-samples on `owns`, in order. `light`: corners of the light's box in the cluster's space.
    pub fn gather(
        &mut self,
        world: &World,
        frame: &Frame,
        owns: impl Iterator<Item = u32>,
        light: ([f32; 3], [f32; 3]),
    ) {
        self.planes.clear();
        self.of_view.clear();
        self.rows.clear();
        let mut last = (u32::MAX, NONE);
        for own in owns {
            if own != last.0 {
                let known = self.planes.iter().position(|plane| plane.triangle == own);
                let at = known.or_else(|| {
                    let corners = world.triangles.get(own as usize)?;
                    self.planes.push(Plane::new(own, corners, world, frame, light));
                    Some(self.planes.len() - 1)
                });
                last = (own, at.map_or(NONE, |at| at as u16));
            }
            self.of_view.push(last.1);
        }
        self.fill_lanes();
        self.complete = !self.of_view.contains(&NONE);
        self.certain = self.planes.iter().all(|plane| plane.normal != [0.0; 3]);
        self.lit = self.planes.iter().all(|plane| plane.lit);
        let sum = self.planes.iter().fold([0.0; 3], |sum: [f32; 3], plane| [0, 1, 2].map(|k| sum[k] + plane.normal[k]));
        let length = dot(sum, sum).sqrt().max(1e-6);
        self.mean = sum.map(|x| x / length);
        (self.spread, self.error, self.size, self.constant) = (0.0, 0.0, 0.0, [f32::MAX, f32::MIN]);
        for plane in &self.planes {
            let apart = [0, 1, 2].map(|k| plane.normal[k] - self.mean[k]);
            self.spread = self.spread.max(apart.iter().fold(0.0, |most: f32, x| most.max(x.abs())) + 1e-6);
            self.error = self.error.max(plane.error);
            self.size = self.size.max(plane.size);
            self.constant = [self.constant[0].min(plane.constant), self.constant[1].max(plane.constant)];
        }
    }

    fn fill_lanes(&mut self) {
        self.by_lanes.fill(&self.planes);
        (self.all_lit, self.all_certain) = (Set::default(), Set::default());
        for (at, plane) in self.planes.iter().enumerate() {
            if plane.lit {
                put(&mut self.all_lit, at);
            }
            if plane.normal != [0.0; 3] {
                put(&mut self.all_certain, at);
            }
        }
    }

    /// What they make of the caster at `place` of `list`, which is triangle `id`, as far as it is told soon.
    #[inline(always)]
    pub fn judge<S: Simd>(&mut self, simd: S, world: &World, list: &Candidates, place: usize, id: u32) -> Verdict {
        if self.planes.is_empty() {
            return Verdict::Plain;
        }
        let (corners, reach) = corners_of(list, place);
        if self.certain {
            let heights = [dot(self.mean, corners[0]), dot(self.mean, corners[1]), dot(self.mean, corners[2])];
            let (low, high) = (heights[0].min(heights[1]).min(heights[2]), heights[0].max(heights[1]).max(heights[2]));
            let room = self.spread * reach + self.error * (reach + self.size);
            let above = high - room + self.constant[0] > 0.0;
            let below = low + room + self.constant[1] < 0.0;
            if above && (self.lit || below) {
                return Verdict::Plain;
            }
            if self.lit && self.complete && high + room + self.constant[1] < 0.0 {
                return Verdict::Never;
            }
        }
        if self.planes.len() <= SOON { self.judge_each(simd, world, list, place, id) } else { Verdict::Open }
    }

    /// The same, sixteen planes at once.
    #[inline(always)]
    pub fn judge_each<S: Simd>(&mut self, simd: S, world: &World, list: &Candidates, place: usize, id: u32) -> Verdict {
        let (corners, reach) = corners_of(list, place);
        let mut row = Row::default();
        let (mut plain, mut never) = (true, self.complete);
        for first in (0..self.planes.len()).step_by(LANES) {
            let lanes = lanes_from(self.planes.len() - first);
            let seen = self.by_lanes.heights(simd, &corners, reach, id, first);
            let (lit, certain) = (part(&self.all_lit, first), part(&self.all_certain, first));
            let (mut above, mut below) = (seen.above & !seen.mine & lanes, seen.below & !seen.mine & lanes);
            let told = certain & (above | seen.not_above) & (below | seen.not_below | lit);
            let mut doubt = lanes & !told & !seen.mine;
            while doubt != 0 {
                let lane = doubt.trailing_zeros() as usize;
                let bit = 1 << lane;
                doubt ^= bit;
                let bits = self.planes[first + lane].corners(world, &mut self.known, id);
                above = if bits & ABOVE != 0 { above | bit } else { above & !bit };
                below = if bits & BELOW != 0 { below | bit } else { below & !bit };
            }
            let lets = above & (lit | below);
            let holds = (seen.mine | (lit & !above)) & lanes;
            put_part(&mut row.above, first, above);
            put_part(&mut row.below, first, below);
            put_part(&mut row.plain, first, lets);
            put_part(&mut row.never, first, holds);
            plain &= lets == lanes;
            never &= holds & !lets == lanes;
        }
        if plain {
            return Verdict::Plain;
        }
        if never {
            return Verdict::Never;
        }
        self.rows.push(row);
        Verdict::Mixed(self.rows.len() as u32 - 1)
    }

    /// Own planes of the view-samples at `places`; filling counts as what it repeats.
    pub fn owners(&self, places: std::ops::Range<usize>) -> Owners {
        let mut owners = Owners::default();
        for &at in &self.of_view[places.start.min(self.of_view.len())..places.end.min(self.of_view.len())] {
            if at == NONE {
                owners.free = true;
            } else {
                put(&mut owners.planes, usize::from(at));
            }
        }
        owners
    }

    /// What a group's planes make of the caster of `row`.
    #[inline]
    pub fn judge_for(&self, owners: &Owners, row: u32) -> Verdict {
        let known = &self.rows[row as usize];
        if is_within(&owners.planes, &known.plain) {
            Verdict::Plain
        } else if !owners.free && is_within(&owners.planes, &known.never) {
            Verdict::Never
        } else {
            Verdict::Mixed(row)
        }
    }

    /// Those of sixteen view-samples from place `views` on that the caster of `row` may block.
    #[inline]
    pub fn possible(&self, row: u32, views: usize) -> u16 {
        let never = &self.rows[row as usize].never;
        let mut possible = 0;
        for lane in 0..LANES {
            let at = self.of_view[(views + lane).min(self.of_view.len() - 1)];
            possible |= u16::from(at == NONE || !has(never, at)) << lane;
        }
        possible
    }

    /// What view-sample `view` makes of the caster of `row`.
    #[inline]
    pub fn admits(&self, row: u32, view: usize) -> Admits {
        let (at, row) = (self.of_view[view], &self.rows[row as usize]);
        if at == NONE || has(&row.plain, at) {
            Admits::All
        } else if has(&row.never, at) {
            Admits::None
        } else {
            Admits::Some
        }
    }

    /// Those of the light samples of block `light` for which view-sample `view`, which admits some, lets the caster of `row` through.
    #[inline(always)]
    pub fn allowed_lights<S: Simd>(
        &mut self,
        simd: S,
        world: &World,
        row: u32,
        view: usize,
        lights: &Blocks,
        light: usize,
    ) -> u16 {
        let (at, row) = (self.of_view[view], &self.rows[row as usize]);
        let sides = self.planes[usize::from(at)].sides(simd, world, lights)[light];
        let mut allowed = !(sides.above | sides.below);
        if has(&row.above, at) {
            allowed |= sides.above;
        }
        if has(&row.below, at) {
            allowed |= sides.below;
        }
        allowed
    }

    /// For each of sixteen view-samples from place `views` on, a bit for each light sample of block `light` for which it lets the
    /// caster of `row` through.
    #[inline(always)]
    pub fn allowed<S: Simd>(
        &mut self,
        simd: S,
        world: &World,
        row: u32,
        views: usize,
        lights: &Blocks,
        light: usize,
    ) -> [u32; LANES] {
        let mut allowed = [0; LANES];
        let mut last = (NONE, u32::from(u16::MAX));
        for (lane, allowed) in allowed.iter_mut().enumerate() {
            // Filling repeats the last view-sample.
            let view = (views + lane).min(self.of_view.len() - 1);
            let at = self.of_view[view];
            if at != last.0 {
                let admits = match self.admits(row, view) {
                    Admits::All => u16::MAX,
                    Admits::None => 0,
                    Admits::Some => self.allowed_lights(simd, world, row, view, lights, light),
                };
                last = (at, u32::from(admits));
            }
            *allowed = last.1;
        }
        allowed
    }
}

/// Corners of a candidate, and what bounds the sums of their absolute coordinates.
fn corners_of(list: &Candidates, place: usize) -> ([[f32; 3]; 3], f32) {
    let [a, g, h] = list.caster(place);
    ([a, [0, 1, 2].map(|k| a[k] + g[k]), [0, 1, 2].map(|k| a[k] + h[k])], size(a) + size(g) + size(h))
}
