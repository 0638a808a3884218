//! The rays of one view-sample to a group of light samples, eight to a lane group, with the cone of all of them.
//!
//! They share their start, so a triangle's corners taken from there, and the three products of its edges, serve every ray. A ray along d
//! meets the closed triangle A, B, C when d . (A x B), d . (B x C), d . (C x A) have the sign of det(A, B, C); it does so before
//! its end when their sum is no less than that. An edge's product changes its sign, and nothing else, when the edge is walked
//! the other way: what passes a shared edge hits one of its triangles, rounded as it may be.

use crate::shared::threaded::{Node, SLAB_ERROR};
use glam::Vec3;

/// Lanes of a group.
pub const LANES: usize = 8;
/// Most rays of a packet.
pub const RAYS: usize = 256;
const GROUPS: usize = RAYS / LANES;

/// Rounding of the cone's answers over the magnitude of what they are made of, with much to spare.
const CONE_ERROR: f32 = 1e-5;

/// Light samples by axis, in groups of lanes; the last group is filled up with its first light sample.
pub struct Lights {
    groups: Vec<[[f32; LANES]; 3]>,
    count: usize,
    low: Vec3,
    high: Vec3,
}

impl Lights {
    /// Of at most [`RAYS`] light samples.
    pub fn new(light_samples: &[[f32; 3]]) -> Self {
        let groups = light_samples
            .chunks(LANES)
            .map(|chunk| [0, 1, 2].map(|k| std::array::from_fn(|lane| chunk.get(lane).unwrap_or(&chunk[0])[k])))
            .collect();
        let all = || light_samples.iter().map(|light| Vec3::from(*light));
        let low = all().fold(Vec3::INFINITY, Vec3::min);
        let high = all().fold(Vec3::NEG_INFINITY, Vec3::max);
        Self { groups, count: light_samples.len(), low, high }
    }
    /// The box of them all.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        [self.low.to_array(), self.high.to_array()]
    }
}

/// The rays, scaled by a power of two so that the longest is about 1.
pub struct Packet {
    from: Vec3,
    /// From the start to each light sample, scaled.
    along: [[[f32; LANES]; 3]; GROUPS],
    count: usize,
    /// Lanes not yet blocked, a word for four groups.
    open: [u32; RAYS / 32],
    scale: f32,
    /// Smallest and largest of `along` on each axis, unscaled, and their reciprocals.
    cone: [[f32; 3]; 2],
    inverse: [[f32; 3]; 2],
    /// Middle and half extent of the cone's end, scaled.
    middle: Vec3,
    half: Vec3,
}

/// A triangle as the start of the rays sees it.
pub struct Seen {
    /// Products of its edges, of the sign that makes all of them positive for a hit.
    edges: [Vec3; 3],
    /// What the sum must not fall below.
    height: f32,
}

/// What the cone says of a triangle.
pub enum Verdict {
    /// No ray hits it.
    Misses,
    /// Every ray does.
    Covers,
    /// Ask the rays.
    Open,
}

/// A power of two that brings `largest` to 1..2, or as near to it as f32 can.
#[inline]
pub fn unit_scale(largest: f32) -> f32 {
    f32::from_bits((254 - (largest.to_bits() >> 23 & 0xff).min(253)) << 23)
}

/// Reciprocal of one end of the cone on one axis, of a size that f32 can hold. An end of zero is on the side of the other end: to
/// rays that go back or stay, what lies ahead is infinitely far, not infinitely far behind.
#[inline(always)]
fn slowness([smallest, largest]: [[f32; 3]; 2], end: usize, axis: usize) -> f32 {
    let x = if end == 0 { smallest[axis] } else { largest[axis] };
    if x.abs() >= 1e-37 {
        return 1.0 / x;
    }
    let goes_back = if x == 0.0 { smallest[axis] < 0.0 } else { x < 0.0 };
    if goes_back { -1e37 } else { 1e37 }
}

impl Packet {
    /// A packet of no rays.
    pub fn new() -> Self {
        Self {
            from: Vec3::ZERO,
            along: [[[0.0; LANES]; 3]; GROUPS],
            count: 0,
            open: [0; RAYS / 32],
            scale: 1.0,
            cone: [[0.0; 3]; 2],
            inverse: [[0.0; 3]; 2],
            middle: Vec3::ZERO,
            half: Vec3::ZERO,
        }
    }

    /// Takes the rays from `from` to all of `lights`, none of them blocked. Answers false where they are not all finite.
    #[inline(always)]
    pub fn aim(&mut self, from: [f32; 3], lights: &Lights) -> bool {
        self.from = Vec3::from(from);
        let (low, high) = (lights.low - self.from, lights.high - self.from);
        if !(low.is_finite() && high.is_finite()) {
            return false;
        }
        self.scale = unit_scale(low.abs().max(high.abs()).max_element());
        for (along, group) in self.along.iter_mut().zip(&lights.groups) {
            for axis in 0..3 {
                for lane in 0..LANES {
                    along[axis][lane] = (group[axis][lane] - from[axis]) * self.scale;
                }
            }
        }
        self.count = lights.count;
        for word in 0..RAYS / 32 {
            self.open[word] = self.all(word);
        }
        self.cone = [low.to_array(), high.to_array()];
        self.inverse = [0, 1].map(|end| [0, 1, 2].map(|axis| slowness(self.cone, end, axis)));
        self.middle = 0.5 * (low * self.scale + high * self.scale);
        self.half = 0.5 * (high * self.scale - low * self.scale);
        true
    }

    /// Lanes of a word of 32 that hold a ray.
    fn all(&self, word: usize) -> u32 {
        let bits = self.count.saturating_sub(32 * word);
        if bits >= 32 { u32::MAX } else { (1 << bits) - 1 }
    }

    /// Lanes of a word of 32 whose ray is blocked.
    pub fn blocked(&self, word: usize) -> u32 {
        self.all(word) & !self.open[word]
    }

    /// Where the first of the rays may enter the box, 0 at its start and 1 at its end, or none where none of them can.
    #[inline(always)]
    pub fn enters(&self, node: Node) -> Option<f32> {
        let (low, high) = (node.low(), node.high());
        let (mut near, mut far) = (f32::NEG_INFINITY, f32::INFINITY);
        for k in 0..3 {
            let (a, b) = (low[k] - self.from[k], high[k] - self.from[k]);
            let [smallest, largest] = [self.cone[0][k], self.cone[1][k]];
            let [inverse_smallest, inverse_largest] = [self.inverse[0][k], self.inverse[1][k]];
            // The least entry and greatest exit of any ray between the two.
            let (entry, exit) = if smallest >= 0.0 {
                (
                    a * if a >= 0.0 { inverse_largest } else { inverse_smallest },
                    b * if b >= 0.0 { inverse_smallest } else { inverse_largest },
                )
            } else if largest <= 0.0 {
                (
                    b * if b <= 0.0 { inverse_smallest } else { inverse_largest },
                    a * if a <= 0.0 { inverse_largest } else { inverse_smallest },
                )
            } else if a > 0.0 {
                (a * inverse_largest, f32::INFINITY)
            } else if b < 0.0 {
                (b * inverse_smallest, f32::INFINITY)
            } else {
                (f32::NEG_INFINITY, f32::INFINITY)
            };
            near = near.max(entry);
            far = far.min(exit);
        }
        let early = near * if near >= 0.0 { 1.0 - SLAB_ERROR } else { 1.0 + SLAB_ERROR };
        let late = far * if far >= 0.0 { 1.0 + SLAB_ERROR } else { 1.0 - SLAB_ERROR };
        (early <= late && late >= 0.0 && early <= 1.0).then_some(near)
    }

    /// The triangle `corners`; none when it is seen edge-on.
    #[inline(always)]
    pub fn see(&self, corners: &[[f32; 3]; 3]) -> Option<Seen> {
        let corners = corners.map(Vec3::from);
        let [a, b, c] = corners.map(|corner| (corner - self.from) * self.scale);
        let (e1, e2) = ((corners[1] - corners[0]) * self.scale, (corners[2] - corners[0]) * self.scale);
        let height = a.dot(e1.cross(e2));
        let edges = [a.cross(b), b.cross(c), c.cross(a)];
        if height > 0.0 {
            Some(Seen { edges, height })
        } else if height < 0.0 {
            Some(Seen { edges: edges.map(|edge| -edge), height: -height })
        } else {
            None
        }
    }

    /// What all rays have in common with regard to a triangle.
    #[inline(always)]
    pub fn judge(&self, seen: &Seen) -> Verdict {
        let (mut all_inside, mut sum, mut sum_reach) = (true, 0.0, 0.0);
        for edge in &seen.edges {
            let (middle, reach) = (self.middle.dot(*edge), self.half.dot(edge.abs()));
            let reach = reach + CONE_ERROR * (self.middle.abs().dot(edge.abs()) + reach);
            if middle + reach < 0.0 {
                return Verdict::Misses;
            }
            all_inside &= middle - reach > 0.0;
            sum += middle;
            sum_reach += reach;
        }
        if sum + sum_reach < seen.height * (1.0 - CONE_ERROR) {
            return Verdict::Misses;
        }
        let covers = all_inside && sum - sum_reach > seen.height * (1.0 + CONE_ERROR);
        if covers { Verdict::Covers } else { Verdict::Open }
    }

    /// The open lanes of group `group` that hit the triangle.
    #[inline(always)]
    fn hits(&self, group: usize, seen: &Seen) -> u32 {
        let along = &self.along[group];
        let dot = |edge: Vec3, lane: usize| along[0][lane] * edge.x + along[1][lane] * edge.y + along[2][lane] * edge.z;
        let mut hit = [0u32; LANES];
        for (lane, hit) in hit.iter_mut().enumerate() {
            let sides = seen.edges.map(|edge| dot(edge, lane));
            let whole = sides[0] + sides[1] + sides[2];
            let is_hit = (sides[0] >= 0.0) & (sides[1] >= 0.0) & (sides[2] >= 0.0) & (whole >= seen.height);
            *hit = u32::from(is_hit) << lane;
        }
        let hit = hit.iter().fold(0, |all, bit| all | bit);
        hit & (self.open[group / 4] >> (group % 4 * LANES)) & 0xff
    }

    /// Closes every open lane whose ray hits the triangle and counts by `counts` (light sample of the packet). Answers whether
    /// none is left open.
    #[inline(always)]
    pub fn close_hits(&mut self, seen: &Seen, mut counts: impl FnMut(usize) -> bool) -> bool {
        for group in 0..self.count.div_ceil(LANES) {
            if self.open[group / 4] >> (group % 4 * LANES) & 0xff == 0 {
                continue;
            }
            let mut hits = self.hits(group, seen);
            while hits != 0 {
                let lane = hits.trailing_zeros() as usize;
                hits &= hits - 1;
                if counts(group * LANES + lane) {
                    self.open[group / 4] &= !(1 << (group % 4 * LANES + lane));
                }
            }
        }
        self.open.iter().all(|open| *open == 0)
    }

    /// Closes every lane.
    pub fn close_all(&mut self) {
        self.open = [0; RAYS / 32];
    }
}
