//! Patches: casters of one facing that are joined across edges, decided together.
//!
//! A caster whose plane divides a shaft's view-samples from its light samples has one facing for all of them. Casters of one facing
//! that share an edge make a patch. How many casters of a patch a segment meets can only change where a segment meets an edge that
//! does not lead on: a silhouette, an open border, an edge of three triangles. Where no segment of the shaft meets such an edge, the
//! patch blocks all of them or none, and one segment tells which: the shaft's bounds hold a way from each segment to any other. A
//! triangle across an edge that the bounds have left out meets nothing within them, nor does that edge; but one that own triangles
//! hold back, or that only the cones of single view-samples miss, is a border.
//!
//! On hair and leaves hardly a patch lacks borders, and looking for one is half of the work. A cluster therefore keeps an account:
//! candidates joined are paid for, those that a patch saved the parts of its shaft are gained.

use super::LANES;
use super::cluster::{Scene, Slot, Worker};
use super::groups::{LightBox, Range, Slanted};
use super::shaft::Shaft;
use crate::shared::neighbours::NONE;
use crate::shared::predicate::blocks;
use fearless_simd::Simd;

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

/// What joining a candidate costs is 1; what a candidate less saves at each halving of the shaft.
const GAIN: i64 = 1;
/// Candidates that a cluster may join, as a multiple of all it has, before the first gain.
const TRIAL: usize = 1;

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
    parent: Vec<u32>,
    open: Vec<bool>,
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

    fn root(&mut self, mut at: u32) -> u32 {
        while self.parent[at as usize] != at {
            let up = self.parent[self.parent[at as usize] as usize];
            self.parent[at as usize] = up;
            at = up;
        }
        at
    }
}

impl Worker {
    /// Decides patches without border among the candidates from `start` on: true when one blocks the whole shaft; else those that
    /// block nothing have left the list.
    pub fn decide_patches<S: Simd>(
        &mut self,
        simd: S,
        scene: &Scene,
        views: Range,
        lights: Range,
        start: usize,
    ) -> bool {
        let (count, parts) = ((self.list.len - start) as i64, views.len() * lights.len());
        let gain = GAIN * (1 + i64::from(parts.ilog2()));
        if scene.patches == Choice::Auto && self.patches.credit < 0 {
            return false;
        }
        self.patches.credit -= count;
        if !self.join(scene, start) {
            return false;
        }
        // One segment against all of them.
        let (view, light) = (views.first * LANES, lights.first * LANES);
        let (from, to) = (self.views.point(view), self.lights.point(light));
        let views = Slanted { centre: from, low: from, high: from, ..Slanted::default() };
        let ray = Shaft::new(views, LightBox { low: to, high: to });
        let end = self.list.len;
        for place in (start..end).step_by(LANES) {
            let lanes = super::lanes_from(end - place);
            let answer = simd.vectorize(
                #[inline(always)]
                || ray.meet(simd, &self.list, place, lanes),
            );
            let mut left = answer.covers | answer.open;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                let at = place + lane;
                let root = self.patches.root((at - start) as u32);
                if self.patches.open[root as usize] {
                    continue;
                }
                if answer.covers >> lane & 1 == 1 || self.is_met(scene, at, view, light) {
                    self.counts.by_patch += 1;
                    self.patches.credit += gain * count;
                    return true;
                }
            }
        }
        let mut kept = start;
        for place in start..end {
            let root = self.patches.root((place - start) as u32);
            if self.patches.open[root as usize] {
                if kept != place {
                    self.list.copy(place, kept);
                }
                kept += 1;
            }
        }
        self.patches.credit += gain * (end - kept) as i64;
        self.list.len = kept;
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

    /// Joins the candidates from `start` on; whether some patch has no border.
    fn join(&mut self, scene: &Scene, start: usize) -> bool {
        let count = self.list.len - start;
        let (slots, flags) = (&self.list.slot[start..start + count], &self.list.flags[start..start + count]);
        let patches = &mut self.patches;
        patches.round += 1;
        patches.parent.clear();
        patches.parent.extend(0..count as u32);
        patches.open.clear();
        for (place, (&slot, &flags)) in slots.iter().zip(flags).enumerate() {
            patches.seen[slot as usize] = [patches.round, place as u32];
            patches.open.push(flags & FACING == 0 || flags & MIXED != 0);
        }
        for place in 0..count {
            if flags[place] & FACING == 0 || flags[place] & MIXED != 0 {
                continue;
            }
            let slot = slots[place] as usize;
            for edge in 0..3 {
                if flags[place] >> edge & 1 == 0 {
                    continue;
                }
                let across = patches.across_edge(scene, &self.slots, slot, edge);
                if across == BORDER {
                    patches.open[place] = true;
                } else if across != OUT && patches.seen[across as usize][0] == patches.round {
                    let other = patches.seen[across as usize][1];
                    if (flags[other as usize] ^ flags[place]) & (FACING | MIXED) == 0 {
                        let (a, b) = (patches.root(place as u32), patches.root(other));
                        patches.parent[a.max(b) as usize] = a.min(b);
                    } else {
                        patches.open[place] = true;
                    }
                } else if across != OUT && !self.slots[across as usize].is_plain() {
                    // It may have left because of own triangles, or because the view-samples' own cones miss it: the way from one
                    // segment of the shaft to another may meet it all the same.
                    patches.open[place] = true;
                }
            }
        }
        let mut closed = false;
        for place in 0..count {
            let root = patches.root(place as u32) as usize;
            let open = patches.open[place];
            patches.open[root] |= open;
        }
        for place in 0..count {
            closed |= !patches.open[place] && patches.parent[place] == place as u32;
        }
        closed
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
