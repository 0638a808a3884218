//! A shaft is narrowed to the casters that stay open; where some do, it is divided, and its smallest parts are tested.

use super::cluster::{Scene, Worker};
use super::groups::Range;
use super::leaf::{Pair, open_lanes, test, transposed};
use super::own::Verdict;
use super::patches::{Choice, EDGES, FROM_ABOVE, FROM_BELOW, MIXED, SIFTED};
use super::shaft::{Answer, Shaft};
use super::{LANES, lanes_from};
use crate::shared::predicate::blocks;
use fearless_simd::{Select, Simd, SimdBase, SimdMask, mask32x16, u32x16};

/// Blocks of view-samples below which own triangles are asked about every candidate: patches need to know.
const FEW: usize = 4;
/// Tests of a caster against sixteen view-samples and sixteen light samples that are made rather than the light divided once more.
const DIRECT: usize = 12;

impl Worker {
    /// Decides the shaft from `views` to `lights`, whose candidates are those from `start` on; they are still there afterwards.
    pub fn divide<S: Simd>(&mut self, simd: S, scene: &Scene, views: Range, lights: Range, start: usize) {
        let end = self.list.len;
        self.counts.shafts += 1;
        self.counts.met += (end - start) as u64;
        let shaft = Shaft::new(self.slanted[views.node], self.boxes[lights.node]);
        let narrowed = simd.vectorize(
            #[inline(always)]
            || self.narrow(simd, scene, &shaft, views, start),
        );
        match narrowed {
            None => {
                self.counts.covered += 1;
                self.fill(views, lights);
            }
            Some(_) if self.list.len == end => self.counts.lit += 1,
            Some(_)
                if scene.patches != Choice::Off
                    && simd.vectorize(
                        #[inline(always)]
                        || self.decide_patches(simd, scene, views, lights, end),
                    ) =>
            {
                self.fill(views, lights);
            }
            Some(_)
                if views.len() == 1
                    && simd.vectorize(
                        #[inline(always)]
                        || self.cast(simd, scene, views.first, lights, end),
                    ) =>
            {
                self.counts.by_rays += 1;
            }
            Some(_)
                if views.len() == 1
                    && simd.vectorize(
                        #[inline(always)]
                        || self.sift(simd, views.first, lights, end),
                    ) =>
            {
                self.counts.lit += 1;
            }
            Some(_) if views.len() == 1 && (lights.len() == 1 || lights.len() * (self.list.len - end) <= DIRECT) => {
                for light in lights.first..lights.last {
                    simd.vectorize(
                        #[inline(always)]
                        || self.leaf(simd, scene, views.first, light, end),
                    );
                }
            }
            Some(views_wider) => {
                let left = self.list.len - end;
                let by_views = lights.len() == 1 || (views.len() > 1 && 2 * views_wider > left);
                let halves = if by_views { views.halves() } else { lights.halves() };
                for half in halves {
                    let (views, lights) = if by_views { (half, lights) } else { (views, half) };
                    self.divide(simd, scene, views, lights, end);
                }
            }
        }
        self.list.len = end;
    }

    /// Puts the candidates from `start` on that stay open on the stack once more; how many are wider through the view-samples.
    /// None when one covers the shaft.
    #[inline(always)]
    fn narrow<S: Simd>(&mut self, simd: S, scene: &Scene, shaft: &Shaft, views: Range, start: usize) -> Option<usize> {
        let end = self.list.len;
        self.list.reserve(end - start + LANES);
        let mut views_wider = 0;
        for place in (start..end).step_by(LANES) {
            let answer = shaft.meet(simd, &self.list, place, lanes_from(end - place));
            let mut keep = answer.open | answer.covers;
            if keep == 0 {
                continue;
            }
            let were = u32x16::from_slice(simd, &self.list.flags[place..place + LANES]) & MIXED;
            let mut mixed = !(were.simd_eq(0).to_bitmask() as u16) & keep;
            let mut left = mixed;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                let bit = 1 << lane;
                left ^= bit;
                // Own triangles are asked where the answer matters: the shaft would be done, or has few view-samples left.
                if views.len() > FEW && answer.covers & bit == 0 {
                    let slot = self.list.slot[place + lane] as usize;
                    if self.slots[slot].verdict == Verdict::Open {
                        continue;
                    }
                }
                match self.judge_slot(simd, scene, place + lane, views.node) {
                    Verdict::Plain => mixed ^= bit,
                    Verdict::Never => (mixed, keep) = (mixed ^ bit, keep ^ bit),
                    Verdict::Mixed(_) | Verdict::Open => {}
                }
            }
            if answer.covers & keep & !mixed != 0 {
                return None;
            }
            let kept = u32x16::from_slice(simd, &self.list.flags[place..place + LANES]) & SIFTED;
            let flags = flags(simd, &answer) | flag(simd, mixed, MIXED) | kept;
            self.list.push_from(simd, place, keep, flags);
            views_wider += (answer.views_wider & keep).count_ones() as usize;
        }
        Some(views_wider)
    }

    #[inline(always)]
    fn judge_slot<S: Simd>(&mut self, simd: S, scene: &Scene, place: usize, node: usize) -> Verdict {
        let slot = self.list.slot[place] as usize;
        if self.slots[slot].verdict == Verdict::Open {
            let triangle = self.slots[slot].triangle;
            self.slots[slot].verdict = self.own.judge_each(simd, &scene.world, &self.list, place, triangle);
        }
        match self.slots[slot].verdict {
            Verdict::Mixed(row) => self.own.judge_for(&self.owners[node], row),
            other => other,
        }
    }

    fn pair(&self, place: usize) -> Pair {
        let flags = self.list.flags[place];
        let shape = &self.shapes[self.list.slot[place] as usize];
        let side = i8::from(flags & FROM_BELOW != 0) - i8::from(flags & FROM_ABOVE != 0);
        Pair {
            caster: shape.caster,
            edge_error: shape.edge_error,
            plane_error: shape.plane_error,
            // An edge's sign means nothing while that of the plane is open.
            edges: if side == 0 { 0b111 } else { (flags & EDGES) as u8 },
            side,
        }
    }

    /// Takes casters near a block of view-samples off the list from `start` on where they cannot block any of them: a group's
    /// bounds are wide beside what is as near as the group is large. True when none is left.
    #[inline(always)]
    fn sift<S: Simd>(&mut self, simd: S, view: usize, lights: Range, start: usize) -> bool {
        let views = view * LANES;
        let mut kept = start;
        for place in start..self.list.len {
            let flags = self.list.flags[place];
            let is_near = flags & (FROM_BELOW | FROM_ABOVE) == 0 || flags & MIXED != 0;
            if is_near && flags & SIFTED == 0 {
                let [x, y, z] = &self.views.at;
                let points = [&x[views..views + LANES], &y[views..views + LANES], &z[views..views + LANES]];
                let mut open = open_lanes(simd, points, &self.boxes[lights.node], &self.pair(place));
                let slot = &mut self.slots[self.list.slot[place] as usize];
                let verdict = slot.verdict;
                if let (Verdict::Mixed(row), true) = (verdict, flags & MIXED != 0) {
                    open &= self.own.possible(row, views);
                }
                if open == 0 {
                    slot.is_sifted = true;
                    continue;
                }
                self.list.flags[place] |= SIFTED;
            }
            if kept != place {
                self.list.copy(place, kept);
            }
            kept += 1;
        }
        self.list.len = kept;
        kept == start
    }

    fn fill(&mut self, views: Range, lights: Range) {
        for view in views.first..views.last {
            let places = self.mask_at(view, lights.first)..self.mask_at(view, lights.last);
            self.masks[places].fill(u16::MAX);
        }
    }

    /// Decides every segment from one block of view-samples to one of light samples, for the candidates from `start` on.
    #[inline(always)]
    fn leaf<S: Simd>(&mut self, simd: S, scene: &Scene, view: usize, light: usize, start: usize) {
        let (views, lights) = (view * LANES, light * LANES);
        let [x, y, z] = &self.views.at;
        let view_points = [&x[views..views + LANES], &y[views..views + LANES], &z[views..views + LANES]];
        let [x, y, z] = &self.lights.at;
        let light_points = [&x[lights..lights + LANES], &y[lights..lights + LANES], &z[lights..lights + LANES]];
        let mut blocked = u32x16::splat(simd, 0);
        for place in start..self.list.len {
            self.counts.tested += 1;
            let pair = self.pair(place);
            let mut found = test(simd, view_points, light_points, &pair);
            let slot = self.slots[self.list.slot[place] as usize];
            if let (Verdict::Mixed(row), true) = (slot.verdict, self.list.flags[place] & MIXED != 0) {
                let allowed = self.own.allowed(simd, &scene.world, row, views, &self.lights, light);
                let allowed = u32x16::from_slice(simd, &allowed);
                found.sure &= allowed;
                found.may &= allowed;
            }
            blocked |= found.sure;
            if blocked.simd_eq(u32::from(u16::MAX)).all_true() {
                break;
            }
            found.may &= !blocked;
            let mut doubt = found.may.simd_ne(0).to_bitmask();
            while doubt != 0 {
                let lane = doubt.trailing_zeros() as usize;
                doubt &= doubt - 1;
                let may = found.may[lane] as u16;
                self.counts.exact += u64::from(may.count_ones());
                let order = &self.lights.index[lights..lights + LANES];
                let met = met_exactly(scene, slot.triangle, self.views.index[views + lane], order, may);
                blocked[lane] |= u32::from(met);
            }
        }
        let at = self.mask_at(view, light);
        self.masks[at..at + LANES].copy_from_slice(&transposed(blocked));
    }

    /// Where the masks of block `view` of view-samples begin for block `light` of light samples.
    pub fn mask_at(&self, view: usize, light: usize) -> usize {
        (view * self.lights.root().last + light) * LANES
    }
}

/// Those of the light samples `may` in `order` that triangle `id` blocks for view-sample `row`, whose own triangle lets it through for
/// them.
pub fn met_exactly(scene: &Scene, id: u32, row: u32, order: &[u32], mut may: u16) -> u16 {
    let position = scene.position[row as usize];
    let caster = &scene.world.triangles[id as usize];
    let mut met = 0;
    while may != 0 {
        let lane = may.trailing_zeros() as usize;
        may &= may - 1;
        let light = scene.world.lights[order[lane] as usize];
        met |= u16::from(blocks(position, None, caster, light)) << lane;
    }
    met
}

/// The flags of sixteen candidates.
#[inline(always)]
fn flags<S: Simd>(simd: S, answer: &Answer) -> u32x16<S> {
    let [a, b, c] = answer.edge;
    let edges = flag(simd, a, 1) | flag(simd, b, 2) | flag(simd, c, 4);
    edges | flag(simd, answer.from_below, FROM_BELOW) | flag(simd, answer.from_above, FROM_ABOVE)
}

#[inline(always)]
fn flag<S: Simd>(simd: S, lanes: u16, flag: u32) -> u32x16<S> {
    mask32x16::from_bitmask(simd, u64::from(lanes)).select(u32x16::splat(simd, flag), u32x16::splat(simd, 0))
}
