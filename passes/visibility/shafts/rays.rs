//! Rays: the segments from one view-sample to sixteen light samples, as a packet with a cone of its own.
//!
//! A leaf asks sixteen view-samples about every caster that their common shaft meets. Where casters are small beside that shaft, most of
//! them are in nobody's way. Here each view-sample v looks for itself: for an edge from a along e, m = (a - v) x e, then
//! f(s) = (s - v) . m for every light sample s, and N . (s - a) = N . (s - v) + N . (v - a). Sixteen casters at once are held against
//! the box of all the lights of the shaft, those left against the box of each sixteen, and what is open there is asked about
//! those sixteen, light samples in the lanes. Signs are turned so that what blocks is positive.
//!
//! Bounds on errors are those of [`super::shaft`]: m, f and the height have fewer roundings here than there. A caster whose plane v
//! is in for all that rounding tells has an infinite error there: either side may be the right one, and the predicate decides.

use super::cluster::{Scene, Worker};
use super::divide::met_exactly;
use super::groups::{LightBox, Range};
use super::leaf::transposed;
use super::own::{Admits, Verdict};
use super::patches::MIXED;
use super::shaft::{SEGMENT_SHARE, TINY, Vector, abs, cross, dot, dot_one, from, load, minus, plus};
use super::{LANES, lanes_from};
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, mask32x16, u32x16};

/// Three products, the normal, the view-sample's height, errors of edges and of the plane.
const ROWS: usize = 15;

/// Casters that a view-sample may see the light through, waiting until they fill a register.
pub struct Seen {
    rows: [[f32; 2 * LANES]; ROWS],
    /// What the cluster knows them by.
    slot: [u32; 2 * LANES],
    /// 1 where own triangles have to be asked light sample by light sample.
    is_mixed: [u32; 2 * LANES],
    len: usize,
    /// Operations on registers so far.
    cost: u64,
    /// Blocks of light samples not wholly blocked, and what is blocked of each.
    open: Vec<(usize, u16)>,
    /// For each block of light samples what is blocked of it for sixteen view-samples.
    found: Vec<u32>,
}

impl Default for Seen {
    fn default() -> Self {
        Self {
            rows: [[0.0; 2 * LANES]; ROWS],
            slot: [0; 2 * LANES],
            is_mixed: [0; 2 * LANES],
            len: 0,
            cost: 0,
            open: Vec::new(),
            found: Vec::new(),
        }
    }
}

/// A box of light samples from a view-sample: middle and half extent.
#[derive(Clone, Copy)]
struct Cone {
    along: [f32; 3],
    half: [f32; 3],
}

impl Cone {
    fn new(view: [f32; 3], light: &LightBox) -> Self {
        let (mut along, mut half) = ([0.0; 3], [0.0; 3]);
        for k in 0..3 {
            along[k] = 0.5 * (light.low[k] + light.high[k]) - view[k];
            half[k] = 0.5 * (light.high[k] - light.low[k]) * (1.0 + 1e-6);
        }
        Self { along, half }
    }

    /// Middle and spread of what is linear with these factors.
    #[inline(always)]
    fn bounds<S: Simd>(&self, factors: Vector<S>) -> (f32x16<S>, f32x16<S>) {
        (dot_one(self.along, factors), dot_one(self.half, abs(factors)))
    }
}

/// How a shaft of one block of view-samples is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// By whichever is estimated to cost less.
    Auto,
    /// Sixteen view-samples against sixteen light samples, caster by caster ([`super::leaf`]).
    Triangles,
    /// View-sample by view-sample.
    Rays,
}

impl Leaves {
    /// Operations on registers that triangles are expected to take for one block of view-samples; rays may not take more.
    fn most(self, lights: usize, casters: usize) -> u64 {
        match self {
            Self::Auto => (lights * casters) as u64 * TRIANGLE_COST,
            Self::Triangles => 0,
            Self::Rays => u64::MAX,
        }
    }
}

/// A caster against sixteen view-samples and sixteen light samples: about half of it, for what is tried in vain is lost at each
/// division of the light.
const TRIANGLE_COST: u64 = 100;
/// Sixteen casters as a view-sample sees them.
const LOOK_COST: u64 = 110;
/// The same against a box of light samples.
const HOLD_COST: u64 = 45;
/// One of them against sixteen light samples.
const CAST_COST: u64 = 30;

#[inline(always)]
fn bits<S: Simd>(mask: mask32x16<S>) -> u16 {
    mask.to_bitmask() as u16
}

impl Worker {
    /// Decides every segment from a block of view-samples to `lights`, for the candidates from `start` on; false when the first
    /// view-sample shows that triangles would cost less.
    #[inline(always)]
    pub fn cast<S: Simd>(&mut self, simd: S, scene: &Scene, block: usize, lights: Range, start: usize) -> bool {
        let views = block * LANES..((block + 1) * LANES).min(self.views.count);
        let most = scene.leaves.most(lights.len(), self.list.len - start);
        // What one view-sample takes at least.
        if (views.len() * (self.list.len - start).div_ceil(LANES)) as u64 * LOOK_COST >= most {
            return false;
        }
        self.seen.cost = 0;
        self.seen.found.clear();
        self.seen.found.resize(lights.len() * LANES, 0);
        for view in views.clone() {
            let limit = if view == views.start { most / views.len() as u64 } else { u64::MAX };
            if !self.look(simd, scene, view, lights, start, limit) {
                return false;
            }
            // Those that have left are full.
            let seen = &mut self.seen;
            let lane = view - views.start;
            for masks in seen.found.chunks_exact_mut(LANES) {
                masks[lane] = u32::from(u16::MAX);
            }
            for &(light, blocked) in &seen.open {
                seen.found[(light - lights.first) * LANES + lane] = u32::from(blocked);
            }
        }
        let at = self.mask_at(block, lights.first);
        for (masks, found) in self.masks[at..].chunks_exact_mut(LANES).zip(self.seen.found.chunks_exact(LANES)) {
            masks.copy_from_slice(&transposed(u32x16::from_slice(simd, found)));
        }
        true
    }

    /// Leaves in `seen.open` what the candidates from `start` on leave of `lights` for view-sample `view`; false when that costs more
    /// than `limit`.
    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, scene: &Scene, view: usize, lights: Range, start: usize, limit: u64) -> bool {
        let at = self.views.point(view);
        let cone = Cone::new(at, &self.boxes[lights.node]);
        let end = self.list.len;
        self.seen.len = 0;
        self.seen.open.clear();
        self.seen.open.extend((lights.first..lights.last).map(|light| (light, 0)));
        let zero = f32x16::splat(simd, 0.0);
        for place in (start..end).step_by(LANES) {
            if self.seen.cost > limit {
                return false;
            }
            self.seen.cost += LOOK_COST;
            let rows = &self.list.rows;
            let a = [load(simd, &rows[0], place), load(simd, &rows[1], place), load(simd, &rows[2], place)];
            let g = [load(simd, &rows[3], place), load(simd, &rows[4], place), load(simd, &rows[5], place)];
            let h = [load(simd, &rows[6], place), load(simd, &rows[7], place), load(simd, &rows[8], place)];
            let edge_error = load(simd, &rows[9], place);
            let plane_error = load(simd, &rows[10], place);
            let a = from(a, at);
            let products = [cross(a, g), cross(plus(a, g), minus(h, g)), cross(h, a)];
            let normal = cross(g, h);
            let height = zero - dot(normal, a);
            let (light_height, light_spread) = cone.bounds(normal);
            let (light_height, light_spread) = (light_height + height, light_spread + plane_error);
            let below = bits((height + plane_error).simd_lt(0.0));
            let above = bits((height - plane_error).simd_gt(0.0));
            let light_below = bits((light_height + light_spread).simd_lt(0.0));
            let light_above = bits((light_height - light_spread).simd_gt(0.0));
            let (mut some_negative, mut some_positive) = (0, 0);
            let (mut all_positive, mut all_negative) = (u16::MAX, u16::MAX);
            for product in &products {
                let (middle, spread) = cone.bounds(*product);
                let spread = spread + edge_error;
                let positive = bits((middle - spread).simd_gt(0.0));
                let negative = bits((middle + spread).simd_lt(0.0));
                some_negative |= negative;
                some_positive |= positive;
                all_positive &= positive;
                all_negative &= negative;
            }
            let misses = (below & light_below)
                | (above & light_above)
                | (some_negative & some_positive)
                | (below & some_negative)
                | (above & some_positive);
            let covers = (below & light_above & all_positive) | (above & light_below & all_negative);
            let mut keep = lanes_from(end - place) & !misses;
            if keep == 0 {
                continue;
            }
            let flags = u32x16::from_slice(simd, &self.list.flags[place..place + LANES]) & MIXED;
            let mut mixed = !bits(flags.simd_eq(0)) & keep;
            let mut left = mixed;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                let bit = 1 << lane;
                left ^= bit;
                let slot = self.list.slot[place + lane] as usize;
                match self.slots[slot].verdict {
                    Verdict::Mixed(row) => match self.own.admits(row, view) {
                        Admits::All => mixed ^= bit,
                        Admits::None => (mixed, keep) = (mixed ^ bit, keep ^ bit),
                        Admits::Some => {}
                    },
                    Verdict::Plain => mixed ^= bit,
                    Verdict::Never => (mixed, keep) = (mixed ^ bit, keep ^ bit),
                    Verdict::Open => {}
                }
            }
            if covers & keep & !mixed != 0 {
                self.seen.open.clear();
                return true;
            }
            // Turned so that what blocks is positive; nothing is certain where the side is not.
            let turn = mask32x16::from_bitmask(simd, u64::from(above));
            let side = turn.select(f32x16::splat(simd, -1.0), f32x16::splat(simd, 1.0));
            let doubt = mask32x16::from_bitmask(simd, u64::from(!(above | below)));
            let infinite = f32x16::splat(simd, f32::INFINITY);
            let [m, n, o] = products;
            let rows = [
                m[0] * side,
                m[1] * side,
                m[2] * side,
                n[0] * side,
                n[1] * side,
                n[2] * side,
                o[0] * side,
                o[1] * side,
                o[2] * side,
                normal[0] * side,
                normal[1] * side,
                normal[2] * side,
                height * side,
                edge_error,
                doubt.select(infinite, plane_error),
            ];
            let mask = mask32x16::from_bitmask(simd, u64::from(keep));
            let seen = &mut self.seen;
            let to = seen.len..seen.len + LANES;
            for (row, values) in rows.iter().zip(&mut seen.rows) {
                row.compress(mask).store_slice(&mut values[to.clone()]);
            }
            let slots = u32x16::from_slice(simd, &self.list.slot[place..place + LANES]);
            slots.compress(mask).store_slice(&mut seen.slot[to.clone()]);
            let is_mixed =
                mask32x16::from_bitmask(simd, u64::from(mixed)).select(u32x16::splat(simd, 1), u32x16::splat(simd, 0));
            is_mixed.compress(mask).store_slice(&mut seen.is_mixed[to]);
            seen.len += keep.count_ones() as usize;
            if seen.len >= LANES {
                self.hold(simd, scene, view, at);
                if self.seen.open.is_empty() {
                    return true;
                }
                let seen = &mut self.seen;
                for row in &mut seen.rows {
                    row.copy_within(LANES.., 0);
                }
                seen.slot.copy_within(LANES.., 0);
                seen.is_mixed.copy_within(LANES.., 0);
                seen.len -= LANES;
            }
        }
        if self.seen.len > 0 {
            self.hold(simd, scene, view, at);
        }
        self.seen.cost <= limit
    }

    /// Holds the first sixteen casters that wait against every block of light samples that is not wholly blocked.
    #[inline(always)]
    fn hold<S: Simd>(&mut self, simd: S, scene: &Scene, view: usize, at: [f32; 3]) {
        let lanes = lanes_from(self.seen.len);
        self.seen.cost += HOLD_COST * self.seen.open.len() as u64;
        let mut kept = 0;
        for index in 0..self.seen.open.len() {
            let (light, blocked) = self.seen.open[index];
            let blocked = self.packet(simd, scene, view, at, light, blocked, lanes);
            if blocked != u16::MAX {
                self.seen.open[kept] = (light, blocked);
                kept += 1;
            }
        }
        self.seen.open.truncate(kept);
    }

    /// What blocks view-sample `view` from the light samples of block `light`, a bit each, beyond `blocked`.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "a part of `hold`")]
    fn packet<S: Simd>(
        &mut self,
        simd: S,
        scene: &Scene,
        view: usize,
        at: [f32; 3],
        light: usize,
        mut blocked: u16,
        lanes: u16,
    ) -> u16 {
        let cone = Cone::new(at, &self.light_boxes[light]);
        let rows = &self.seen.rows;
        let edge_error = load(simd, &rows[13], 0);
        let plane_error = load(simd, &rows[14], 0);
        let normal = [load(simd, &rows[9], 0), load(simd, &rows[10], 0), load(simd, &rows[11], 0)];
        let (height, spread) = cone.bounds(normal);
        let height = height + load(simd, &rows[12], 0);
        let mut open = height + spread + plane_error;
        let mut covers = height - spread - plane_error;
        let m = [load(simd, &rows[0], 0), load(simd, &rows[1], 0), load(simd, &rows[2], 0)];
        let n = [load(simd, &rows[3], 0), load(simd, &rows[4], 0), load(simd, &rows[5], 0)];
        let o = [load(simd, &rows[6], 0), load(simd, &rows[7], 0), load(simd, &rows[8], 0)];
        let products = [m, n, o];
        for product in &products {
            let (middle, spread) = cone.bounds(*product);
            let spread = spread + edge_error;
            open = open.min(middle + spread);
            covers = covers.min(middle - spread);
        }
        let doubt = bits(plane_error.simd_gt(f32::MAX));
        let mut open = (bits(open.simd_ge(0.0)) | doubt) & lanes;
        if open == 0 {
            return blocked;
        }
        let covers = bits(covers.simd_gt(0.0)) & open;
        if covers != 0 {
            let mixed = u32x16::from_slice(simd, &self.seen.is_mixed[..LANES]);
            if covers & bits(mixed.simd_eq(0)) != 0 {
                return u16::MAX;
            }
        }
        let first = light * LANES;
        let [x, y, z] = &self.lights.at;
        let segments = from([load(simd, x, first), load(simd, y, first), load(simd, z, first)], at);
        while open != 0 {
            let entry = open.trailing_zeros() as usize % LANES;
            open &= open - 1;
            self.counts.cast += 1;
            self.seen.cost += CAST_COST;
            let rows = &self.seen.rows;
            let sides = [
                dot_one([rows[0][entry], rows[1][entry], rows[2][entry]], segments),
                dot_one([rows[3][entry], rows[4][entry], rows[5][entry]], segments),
                dot_one([rows[6][entry], rows[7][entry], rows[8][entry]], segments),
            ];
            let lowest = sides[0].min(sides[1]).min(sides[2]);
            let height = dot_one([rows[9][entry], rows[10][entry], rows[11][entry]], segments) + rows[12][entry];
            let (edge, plane) = (SEGMENT_SHARE * rows[13][entry] + TINY, rows[14][entry]);
            let mut may = bits(lowest.simd_ge(-edge) & height.simd_ge(-plane));
            if doubt >> entry & 1 == 1 {
                // Either side of the plane may be the right one.
                may |= bits(sides[0].max(sides[1]).max(sides[2]).simd_le(edge));
            }
            may &= !blocked;
            if may == 0 {
                continue;
            }
            let mut sure = bits(lowest.simd_gt(edge) & height.simd_gt(plane));
            let slot = self.slots[self.seen.slot[entry] as usize];
            if let (Verdict::Mixed(row), 1) = (slot.verdict, self.seen.is_mixed[entry]) {
                let allowed = self.own.allowed_lights(simd, &scene.world, row, view, &self.lights, light);
                (sure, may) = (sure & allowed, may & allowed);
            }
            blocked |= sure;
            may &= !blocked;
            if may != 0 {
                self.counts.exact += u64::from(may.count_ones());
                let order = &self.lights.index[first..first + LANES];
                blocked |= met_exactly(scene, slot.triangle, self.views.index[view], order, may);
            }
            if blocked == u16::MAX {
                return blocked;
            }
        }
        blocked
    }
}
