//! The own triangles of a cluster's view-samples, and which casters they let through.
//!
//! A caster with no corner strictly above the plane of the triangle that a view-sample lies on, on the light sample's side, cannot
//! block there ([`crate::shared::predicate`]), and no triangle blocks points of itself. Bounds over all planes of the cluster
//! settle most casters at once; what is left is looked at plane by plane, in doubt exactly, once for the cluster.

use super::candidates::Candidates;
use super::groups::{Frame, cross, dot, size};
use super::shaft::{PLANE_ERROR, dot_one, load};
use super::{LANES, MOST_VIEWS, lanes_from};
use crate::shared::predicate::{Corners, side};
use fearless_simd::{Simd, SimdBase, SimdMask, u32x16};
use std::collections::HashMap;

/// Planes of a cluster that every caster is held against at once; with more, only where it matters.
const SOON: usize = 4;
/// Answers of the exact predicate that a thread keeps at most.
const MOST_KNOWN: usize = 1 << 18;

/// An own triangle.
struct Plane {
    triangle: u32,
    /// Unit normal, towards the middle of the light, and constant; zero when in doubt.
    normal: [f32; 3],
    constant: f32,
    /// Bound on the error of a height, as a share of the sizes of both points.
    error: f32,
    size: f32,
    /// The side of the world's plane that is above here: 1 or -1.
    up: i32,
    /// All light samples are above for certain.
    lit: bool,
    /// Where the world's plane is one of equal x, y or z.
    level: Option<Level>,
    /// Sides of all light samples, exactly; made when first asked for.
    sides: Vec<i8>,
}

/// A plane `p[axis] = at`: on which side a point is needs a comparison. Floors and walls often are such, and others level with them.
#[derive(Clone, Copy, Debug)]
struct Level {
    axis: usize,
    at: f32,
    /// The side beyond: 1, -1, or 0 for a degenerate triangle.
    beyond: i32,
}

impl Level {
    fn of(corners: &Corners) -> Option<Self> {
        let axis = (0..3).find(|&axis| corners.iter().all(|corner| corner[axis] == corners[0][axis]))?;
        let at = corners[0][axis];
        // The side is linear in the distance: one point off the plane tells its sign.
        let mut off = corners[0];
        off[axis] = if at > 0.0 { at.next_down() } else { at.next_up() };
        let beyond = side(corners, off) * if at > 0.0 { -1 } else { 1 };
        Some(Self { axis, at, beyond })
    }

    /// As [`side`].
    fn side(&self, point: [f32; 3]) -> i32 {
        let x = point[self.axis];
        self.beyond * (i32::from(x > self.at) - i32::from(x < self.at))
    }
}

/// Planes by lanes.
#[derive(Default)]
struct Rows {
    /// Normal, constant, error, size.
    of: [Vec<f32>; 6],
    /// The triangle of each.
    triangle: Vec<u32>,
}

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

/// Whether a caster has corners strictly there.
const ABOVE: u8 = 1;
const BELOW: u8 = 2;

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
        let padded = self.planes.len().next_multiple_of(LANES);
        for row in &mut self.by_lanes.of {
            row.clear();
        }
        self.by_lanes.triangle.clear();
        (self.all_lit, self.all_certain) = (Set::default(), Set::default());
        for (at, plane) in self.planes.iter().enumerate() {
            let [x, y, z] = plane.normal;
            for (row, value) in self.by_lanes.of.iter_mut().zip([x, y, z, plane.constant, plane.error, plane.size]) {
                row.push(value);
            }
            self.by_lanes.triangle.push(plane.triangle);
            if plane.lit {
                put(&mut self.all_lit, at);
            }
            if plane.normal != [0.0; 3] {
                put(&mut self.all_certain, at);
            }
        }
        for row in &mut self.by_lanes.of {
            row.resize(padded, 0.0);
        }
        self.by_lanes.triangle.resize(padded, u32::MAX);
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

    /// Those of sixteen light samples for which view-sample `view`, which admits some, lets the caster of `row` through.
    /// `order`: light samples by place.
    pub fn allowed_lights(&mut self, world: &World, row: u32, view: usize, order: &[u32]) -> u16 {
        let (at, row) = (self.of_view[view], &self.rows[row as usize]);
        let (above, below) = (has(&row.above, at), has(&row.below, at));
        let sides = self.planes[usize::from(at)].sides(world);
        order.iter().enumerate().fold(0, |allowed, (lane, light)| {
            let admits = match sides[*light as usize] {
                0 => true,
                1 => above,
                _ => below,
            };
            allowed | u16::from(admits) << lane
        })
    }

    /// For each of sixteen light samples, a bit for each of sixteen view-samples that lets the caster of `row` through.
    /// `views`: first place; `order`: light samples by place.
    pub fn allowed(&mut self, world: &World, row: u32, views: usize, order: &[u32]) -> [u16; LANES] {
        let row = &self.rows[row as usize];
        let (mut always, mut sometimes) = (0u16, 0u16);
        for lane in 0..LANES {
            // Filling repeats the last view-sample.
            let at = self.of_view[(views + lane).min(self.of_view.len() - 1)];
            if at == NONE || has(&row.plain, at) {
                always |= 1 << lane;
            } else if !has(&row.never, at) {
                sometimes |= 1 << lane;
            }
        }
        let mut allowed = [always; LANES];
        while sometimes != 0 {
            let lane = sometimes.trailing_zeros() as usize;
            sometimes &= sometimes - 1;
            let at = self.of_view[(views + lane).min(self.of_view.len() - 1)];
            let (above, below) = (has(&row.above, at), has(&row.below, at));
            let sides = self.planes[usize::from(at)].sides(world);
            for (allowed, light) in allowed.iter_mut().zip(order) {
                let admits = match sides[*light as usize] {
                    0 => true,
                    1 => above,
                    _ => below,
                };
                *allowed |= u16::from(admits) << lane;
            }
        }
        allowed
    }
}

/// Corners of a candidate, and what bounds the sums of their absolute coordinates.
fn corners_of(list: &Candidates, place: usize) -> ([[f32; 3]; 3], f32) {
    let [a, g, h] = list.caster(place);
    ([a, [0, 1, 2].map(|k| a[k] + g[k]), [0, 1, 2].map(|k| a[k] + h[k])], size(a) + size(g) + size(h))
}

/// What sixteen planes see of a caster's corners for certain, a bit each.
struct Seen {
    /// One above.
    above: u16,
    /// One below.
    below: u16,
    /// All below.
    not_above: u16,
    /// All above.
    not_below: u16,
    /// It is the plane's own triangle.
    mine: u16,
}

impl Rows {
    /// Planes `first..first + 16`.
    #[inline(always)]
    fn heights<S: Simd>(&self, simd: S, corners: &[[f32; 3]; 3], reach: f32, id: u32, first: usize) -> Seen {
        let [x, y, z, constant, error, size] = &self.of;
        let normal = [load(simd, x, first), load(simd, y, first), load(simd, z, first)];
        let constant = load(simd, constant, first);
        let room = load(simd, error, first) * (load(simd, size, first) + reach);
        let heights = [
            dot_one(corners[0], normal) + constant,
            dot_one(corners[1], normal) + constant,
            dot_one(corners[2], normal) + constant,
        ];
        let low = heights[0].min(heights[1]).min(heights[2]);
        let high = heights[0].max(heights[1]).max(heights[2]);
        let triangles = u32x16::from_slice(simd, &self.triangle[first..first + LANES]);
        Seen {
            above: high.simd_gt(room).to_bitmask() as u16,
            below: (low + room).simd_lt(0.0).to_bitmask() as u16,
            not_above: (high + room).simd_lt(0.0).to_bitmask() as u16,
            not_below: low.simd_gt(room).to_bitmask() as u16,
            mine: triangles.simd_eq(id).to_bitmask() as u16,
        }
    }
}

impl Plane {
    fn new(triangle: u32, corners: &Corners, world: &World, frame: &Frame, light: ([f32; 3], [f32; 3])) -> Self {
        let units = corners.map(|p| world.unit(p));
        let origin = frame.point(units[0]);
        let [g, h] = [1, 2].map(|k| frame.turn([0, 1, 2].map(|axis| units[k][axis] - units[0][axis])));
        let normal = cross(g, h);
        let length = dot(normal, normal).sqrt();
        let share = size(g) * size(h) / length;
        let mut plane = Self {
            triangle,
            normal: [0.0; 3],
            constant: 0.0,
            error: PLANE_ERROR * share,
            size: size(origin) + size(g) + size(h),
            up: 1,
            lit: false,
            level: Level::of(corners),
            sides: Vec::new(),
        };
        if !(share < 1e4 && length > 1e-30) {
            return plane;
        }
        let middle = [0, 1, 2].map(|k| 0.5 * (light.0[k] + light.1[k]));
        let half = [0, 1, 2].map(|k| 0.5 * (light.1[k] - light.0[k]));
        let unit = normal.map(|x| x / length);
        let height = dot(unit, middle) - dot(unit, origin);
        let turn = if height < 0.0 { -1.0 } else { 1.0 };
        plane.normal = unit.map(|x| turn * x);
        plane.constant = -dot(plane.normal, origin);
        // orient3d is positive below a triangle that turns counter-clockwise seen from above.
        plane.up = if height < 0.0 { 1 } else { -1 };
        let spread = unit[0].abs() * half[0] + unit[1].abs() * half[1] + unit[2].abs() * half[2];
        plane.lit = height.abs() - spread > plane.error * (size(middle) + size(half) + plane.size);
        plane
    }

    /// Which sides of the plane the caster has corners on, exactly.
    fn corners(&self, world: &World, known: &mut HashMap<u64, u8>, id: u32) -> u8 {
        let sides_of = |side: &dyn Fn([f32; 3]) -> i32| {
            world.triangles[id as usize].iter().fold(0, |bits, corner| match side(*corner) {
                1 => bits | ABOVE,
                -1 => bits | BELOW,
                _ => bits,
            })
        };
        let bits = if let Some(level) = self.level {
            sides_of(&|corner| level.side(corner))
        } else {
            let key = u64::from(self.triangle) << 32 | u64::from(id);
            if let Some(bits) = known.get(&key) {
                *bits
            } else {
                if known.len() >= MOST_KNOWN {
                    known.clear();
                }
                let own = &world.triangles[self.triangle as usize];
                let bits = sides_of(&|corner| if own.contains(&corner) { 0 } else { side(own, corner) });
                known.insert(key, bits);
                bits
            }
        };
        let (up, down) = (bits & ABOVE, bits & BELOW);
        // What is known is about the plane as the predicate turns it.
        if self.up > 0 { up | down } else { (up << 1) | (down >> 1) }
    }

    /// 1 above, -1 below, 0 in the plane, for every light sample.
    fn sides(&mut self, world: &World) -> &[i8] {
        if self.sides.is_empty() {
            let own = &world.triangles[self.triangle as usize];
            let (level, up) = (self.level, self.up);
            let side_of = |light: [f32; 3]| level.map_or_else(|| side(own, light), |level| level.side(light));
            self.sides.extend(world.lights.iter().map(|light| (side_of(*light) * up) as i8));
        }
        &self.sides
    }
}
