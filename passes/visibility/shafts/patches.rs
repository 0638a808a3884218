//! Patches: casters of one facing that are joined across edges, decided together.
//!
//! A caster whose plane divides a shaft's view-samples from its light samples has one facing for all of them. Casters of one facing
//! that share an edge make a patch. How many casters of a patch a segment meets can only change where a segment meets an edge that
//! does not lead on: a silhouette, an open border, an edge of three triangles. Where no segment of the shaft meets such an edge, the
//! patch blocks all of them or none, and one segment tells which: the shaft's bounds hold a way from each segment to any other. A
//! triangle across an edge that the bounds have left out meets nothing within them, nor does that edge; but one that own triangles
//! hold back, or that only the cones of single view-samples miss, is a border.
//!
//! A patch that blocks a shaft blocks its middle segment. Where nothing seems to be in the way of that, nothing is joined; else a patch
//! is followed from the caster in the way, until it ends or shows a border, mostly at once.
//!
//! On hair and leaves hardly a patch lacks borders. A cluster therefore keeps an account: candidates looked at are paid for, those that
//! a patch saved the parts of its shaft are gained.

use super::LANES;
use super::candidates::Candidates;
use super::cluster::{Scene, Slot, Worker};
use super::groups::Range;
use super::shaft::{cross, dot, dot_one, load};
use crate::shared::neighbours::NONE;
use crate::shared::predicate::blocks;
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16};

/// When joined casters are decided together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// As long as it pays in a cluster.
    Auto,
    /// Always.
    Always,
    /// Never.
    Off,
}

/// What looking at a candidate of a patch costs is 1; what a candidate less saves at each halving of the shaft.
const GAIN: i64 = 16;
/// Candidates of patches that a cluster may look at, as a multiple of all it has, before the first gain.
const TRIAL: usize = 16;

/// The candidate's flags: edges that some segment may meet, then its facing.
pub const EDGES: u32 = 0b111;
/// Seen from below for certain.
pub const FROM_BELOW: u32 = 8;
/// Seen from above for certain.
pub const FROM_ABOVE: u32 = 16;
/// Own triangles have to be asked view-sample by view-sample.
pub const MIXED: u32 = 32;
/// Looked at view-sample by view-sample.
pub const SIFTED: u32 = 64;
const FACING: u32 = FROM_BELOW | FROM_ABOVE;

/// Across an edge of a slot: not a candidate of the cluster, and in nobody's way.
pub const OUT: u32 = u32::MAX;
/// Across an edge of a slot: nothing that the patch could go on with.
const BORDER: u32 = u32::MAX - 1;
/// Not yet looked up.
pub const UNKNOWN: u32 = u32::MAX - 2;
/// A triangle that own triangles hold back.
pub const HELD_BACK: u32 = u32::MAX - 1;

/// What a thread keeps.
#[derive(Default)]
pub struct Patches {
    /// By triangle: its slot, `OUT`, or `HELD_BACK`.
    pub slot_of: Vec<u32>,
    /// Triangles whose entry is not `OUT`.
    pub named: Vec<u32>,
    /// By slot: what lies across each edge.
    pub across: Vec<[u32; 3]>,
    /// By slot: the round in which it was last a candidate, and its place then.
    pub seen: Vec<[u32; 2]>,
    round: u32,
    /// Candidates that may still be joined before joining must have paid.
    credit: i64,
    /// Whether [`Self::seen`] is of the shaft's candidates.
    is_joined: bool,
    /// By place in the list: which patch, of those looked at, has reached it.
    visited: Vec<u32>,
    looked_at: u32,
    stack: Vec<u32>,
}

impl Patches {
    /// Forgets the last cluster.
    pub fn clear(&mut self, triangles: usize) {
        for triangle in self.named.drain(..) {
            self.slot_of[triangle as usize] = OUT;
        }
        self.slot_of.resize(triangles, OUT);
        self.across.clear();
        self.seen.clear();
        self.round = 0;
    }

    /// Starts the account of a cluster.
    pub fn open_account(&mut self, candidates: usize) {
        self.credit = (TRIAL * candidates) as i64;
    }

    /// Enters a triangle.
    pub fn name(&mut self, triangle: u32, slot: u32) {
        self.slot_of[triangle as usize] = slot;
        self.named.push(triangle);
    }
}

impl Worker {
    /// Whether a patch without border among the candidates from `start` on blocks the whole shaft. Only patches that one segment meets
    /// are looked at: no other could.
    #[inline(always)]
    pub fn decide_patches<S: Simd>(
        &mut self,
        simd: S,
        scene: &Scene,
        views: Range,
        lights: Range,
        start: usize,
    ) -> bool {
        if scene.patches == Choice::Auto && self.patches.credit < 0 {
            return false;
        }
        let middle = |range: Range| (range.first + range.last) * LANES / 2;
        let (view, light) = (middle(views), middle(lights));
        let (from, to) = (self.views.point(view), self.lights.point(light));
        let end = self.list.len;
        self.patches.is_joined = false;
        for place in (start..end).step_by(LANES) {
            let mut left = pierced(simd, &self.list, place, from, to) & super::lanes_from(end - place);
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                if self.is_closed(scene, start, place + lane) && self.is_met(scene, place + lane, view, light) {
                    let halvings = 1 + i64::from((views.len() * lights.len()).ilog2());
                    self.counts.by_patch += 1;
                    self.patches.credit += GAIN * halvings * (end - start) as i64;
                    return true;
                }
            }
        }
        false
    }

    fn is_met(&mut self, scene: &Scene, place: usize, view: usize, light: usize) -> bool {
        self.counts.exact += 1;
        let row = self.views.index[view] as usize;
        let light = scene.world.lights[self.lights.index[light] as usize];
        let own = scene.world.triangles.get(scene.triangle[row] as usize);
        let caster = self.slots[self.list.slot[place] as usize].triangle;
        blocks(scene.position[row], own, &scene.world.triangles[caster as usize], light)
    }

    /// Whether the patch of the candidate at `place` has no border.
    fn is_closed(&mut self, scene: &Scene, start: usize, place: usize) -> bool {
        let (slots, flags) = (&self.list.slot[start..self.list.len], &self.list.flags[start..self.list.len]);
        let patches = &mut self.patches;
        let place = place - start;
        if flags[place] & FACING == 0 || flags[place] & MIXED != 0 {
            return false;
        }
        if !patches.is_joined {
            // Most that have a border have it here.
            for edge in 0..3 {
                if flags[place] >> edge & 1 == 1
                    && patches.across_edge(scene, &self.slots, slots[place] as usize, edge) == BORDER
                {
                    return false;
                }
            }
            patches.is_joined = true;
            patches.round += 1;
            patches.credit -= slots.len() as i64;
            for (&slot, at) in slots.iter().zip(0..) {
                patches.seen[slot as usize] = [patches.round, at];
            }
            patches.visited.clear();
            patches.visited.resize(slots.len(), 0);
            patches.looked_at = 0;
        }
        if patches.visited[place] != 0 {
            // Of a patch that has a border, or that the segment does not meet after all.
            return false;
        }
        patches.looked_at += 1;
        patches.visited[place] = patches.looked_at;
        patches.stack.clear();
        patches.stack.push(place as u32);
        while let Some(at) = patches.stack.pop() {
            let at = at as usize;
            patches.credit -= 1;
            for edge in 0..3 {
                if flags[at] >> edge & 1 == 0 {
                    continue;
                }
                let across = patches.across_edge(scene, &self.slots, slots[at] as usize, edge);
                if across == BORDER {
                    return false;
                } else if across != OUT && patches.seen[across as usize][0] == patches.round {
                    let other = patches.seen[across as usize][1] as usize;
                    if (flags[other] ^ flags[at]) & (FACING | MIXED) != 0 {
                        return false;
                    }
                    if patches.visited[other] == 0 {
                        patches.visited[other] = patches.looked_at;
                        patches.stack.push(other as u32);
                    } else if patches.visited[other] != patches.looked_at {
                        // What lies beyond was not looked at to its end.
                        return false;
                    }
                } else if across != OUT && !self.slots[across as usize].is_plain() {
                    // It may have left because of own triangles, or because the view-samples' own cones miss it: the way from one
                    // segment of the shaft to another may meet it all the same.
                    return false;
                }
            }
        }
        true
    }
}

impl Patches {
    /// What lies across `edge` of `slot`.
    #[inline]
    fn across_edge(&mut self, scene: &Scene, slots: &[Slot], slot: usize, edge: usize) -> u32 {
        let known = self.across[slot][edge];
        if known != UNKNOWN {
            return known;
        }
        let neighbour = scene.neighbours.across(slots[slot].triangle, edge);
        let across = if neighbour == NONE {
            BORDER
        } else {
            match self.slot_of[neighbour as usize] {
                HELD_BACK => BORDER,
                other => other,
            }
        };
        self.across[slot][edge] = across;
        across
    }
}

/// Those of sixteen candidates that the line through `from` and `to` seems to meet: where to look first, no more.
#[inline(always)]
fn pierced<S: Simd>(simd: S, list: &Candidates, place: usize, from: [f32; 3], to: [f32; 3]) -> u16 {
    let rows = &list.rows;
    let a = [load(simd, &rows[0], place), load(simd, &rows[1], place), load(simd, &rows[2], place)];
    let g = [load(simd, &rows[3], place), load(simd, &rows[4], place), load(simd, &rows[5], place)];
    let h = [load(simd, &rows[6], place), load(simd, &rows[7], place), load(simd, &rows[8], place)];
    let along = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    let a = [a[0] - from[0], a[1] - from[1], a[2] - from[2]];
    // along x a
    let q = [
        a[2].mul_sub(along[1], a[1] * along[2]),
        a[0].mul_sub(along[2], a[2] * along[0]),
        a[1].mul_sub(along[0], a[0] * along[1]),
    ];
    let first = dot(g, q);
    let last = f32x16::splat(simd, 0.0) - dot(h, q);
    let other = dot_one(along, cross(g, h)) - first - last;
    let (low, high) = (first.min(last).min(other), first.max(last).max(other));
    (low.simd_ge(0.0) | high.simd_le(0.0)).to_bitmask() as u16
}
