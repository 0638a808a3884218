//! One cluster: gathers casters, divides its shaft until every part is decided.

use super::candidates::Candidates;
use super::groups::{Blocks, Frame, LightBox, Slanted, every, join_boxes, size, tree_len};
use super::halving::Points;
use super::order::Order;
use super::own::{OwnPlanes, Owners, Verdict, World};
use super::patches::{Choice, HELD_BACK, MIXED, Patches, UNKNOWN};
use super::rays::{Leaves, Seen};
use super::shaft::{
    CORNER_ERROR, EDGE_ERROR, PLANE_ERROR, SEGMENT_SHARE, Shaft, TINY, Vector, dot, dot_one, from, load, minus,
};
use super::tree::{Casters, Node};
use super::{LANES, lanes_from};
use crate::shared::neighbours::Neighbours;
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16, u16x32, u32x16};

/// What a cluster reads.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// Triangles and lights as they came.
    pub world: World<'a>,
    /// Casters.
    pub casters: &'a Casters,
    /// Triangles across edges.
    pub neighbours: &'a Neighbours,
    /// When patches are decided together.
    pub patches: Choice,
    /// How blocks of view-samples are decided.
    pub leaves: Leaves,
    /// View-samples.
    pub position: &'a [[f32; 3]],
    /// Triangle of each.
    pub triangle: &'a [u32],
    /// Light samples, scaled.
    pub lights: &'a Points,
    /// 0, 1, 2 ..
    pub light_index: &'a [u32],
    /// Their middle.
    pub light: [f32; 3],
}

/// What was counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Shafts looked at.
    pub shafts: u64,
    /// Found to hold no caster.
    pub lit: u64,
    /// Found to be blocked by one caster.
    pub covered: u64,
    /// Found to be blocked by one patch.
    pub by_patch: u64,
    /// (caster, shaft) pairs looked at on the way.
    pub met: u64,
    /// (caster, leaf) pairs tested segment by segment.
    pub tested: u64,
    /// Shafts left to rays.
    pub by_rays: u64,
    /// (caster, view-sample, block of light samples) tested segment by segment.
    pub cast: u64,
    /// Segments that the exact predicate decided for one caster.
    pub exact: u64,
}

impl Counts {
    /// Sums.
    pub fn add(&mut self, other: &Self) {
        self.shafts += other.shafts;
        self.lit += other.lit;
        self.covered += other.covered;
        self.by_patch += other.by_patch;
        self.met += other.met;
        self.tested += other.tested;
        self.by_rays += other.by_rays;
        self.cast += other.cast;
        self.exact += other.exact;
    }
}

/// A caster of the cluster.
#[derive(Clone, Copy)]
pub struct Slot {
    /// Its index.
    pub triangle: u32,
    /// What own triangles make of it.
    pub verdict: Verdict,
    /// Left a list because the cones of single view-samples miss it.
    pub is_sifted: bool,
}

impl Slot {
    /// Whether it leaves a list only where the bounds of a shaft leave it out.
    pub fn is_plain(&self) -> bool {
        self.verdict == Verdict::Plain && !self.is_sifted
    }
}

/// A caster, all that a leaf reads of it in one place.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Shape {
    /// First corner and edges.
    pub caster: [[f32; 3]; 3],
    /// Bound on the error of an edge's function for one segment.
    pub edge_error: f32,
    /// Bound on the error of the plane's.
    pub plane_error: f32,
}

/// What a thread keeps from cluster to cluster.
#[derive(Default)]
pub struct Worker {
    points: Vec<[f32; 3]>,
    view_points: Points,
    frame: Frame,
    /// View-samples of the cluster.
    pub views: Blocks,
    /// Light samples as the cluster sees them.
    pub lights: Blocks,
    /// Boxes of view-samples, by node.
    pub slanted: Vec<Slanted>,
    /// Boxes of light samples, by node.
    pub boxes: Vec<LightBox>,
    /// The same of blocks.
    pub light_boxes: Vec<LightBox>,
    /// Casters that may matter.
    pub list: Candidates,
    /// All casters of the cluster.
    pub slots: Vec<Slot>,
    /// What the leaves read of each.
    pub shapes: Vec<Shape>,
    /// Own triangles.
    pub own: OwnPlanes,
    /// Those of groups of view-samples, by node.
    pub owners: Vec<Owners>,
    /// Casters as one view-sample sees them.
    pub seen: Seen,
    /// Memory of [`Self::decide_patches`].
    pub patches: Patches,
    stack: Vec<u32>,
    order: Order,
    /// A bit for each of sixteen view-samples, for each block of them and each light sample by place.
    pub masks: Vec<u16>,
    /// Place of each light sample.
    places: Vec<u32>,
    words: Vec<u32>,
    /// What was counted.
    pub counts: Counts,
}

impl Worker {
    /// Decides the view-samples `rows`, all of them finite; their bits are then read by [`Self::write`].
    pub fn cluster<S: Simd>(&mut self, simd: S, scene: &Scene, rows: &[u32]) {
        self.points.clear();
        self.points.extend(rows.iter().map(|&row| scene.world.unit(scene.position[row as usize])));
        self.frame = Frame::new(&self.points, scene.light);
        let frame = self.frame;
        self.view_points.fill(self.points.iter().copied());
        simd.vectorize(
            #[inline(always)]
            || {
                self.views.fill(simd, &frame, &self.view_points, rows);
                self.lights.fill(simd, &frame, scene.lights, scene.light_index);
            },
        );
        let (views, lights) = (self.views.root(), self.lights.root());
        self.slanted.resize(tree_len(views.last), Slanted::default());
        every(views, &mut |range| self.slanted[range.node] = self.views.slanted(range));
        self.boxes.resize(tree_len(lights.last), LightBox::default());
        self.light_boxes.resize(lights.last, LightBox::default());
        simd.vectorize(
            #[inline(always)]
            || self.lights.light_boxes(simd, &mut self.light_boxes),
        );
        join_boxes(lights, &self.light_boxes, &mut self.boxes);
        self.masks.clear();
        self.masks.resize(views.last * LANES * lights.last, 0);
        let owns = self.views.index[..self.views.count].iter().map(|&row| scene.triangle[row as usize]);
        self.own.gather(&scene.world, &frame, owns, (self.boxes[0].low, self.boxes[0].high));
        self.owners.resize(tree_len(views.last), Owners::default());
        every(views, &mut |range| {
            self.owners[range.node] = self.own.owners(range.first * LANES..range.last * LANES);
        });
        self.list.len = 0;
        self.gather(simd, scene);
        if self.list.len > 0 {
            let end = self.list.len;
            simd.vectorize(
                #[inline(always)]
                || self.order.push_sorted(simd, &mut self.list),
            );
            self.divide(simd, scene, views, lights, end);
        } else {
            self.counts.lit += 1;
        }
    }

    /// Puts every caster that may matter on the list.
    fn gather<S: Simd>(&mut self, simd: S, scene: &Scene) {
        let shaft = Shaft::new(self.slanted[0], self.boxes[0]);
        let walls = self.walls(&shaft);
        self.slots.clear();
        self.shapes.clear();
        self.stack.clear();
        self.stack.extend((!scene.casters.nodes.is_empty()).then_some(0));
        while let Some(index) = self.stack.pop() {
            let node = &scene.casters.nodes[index as usize];
            let mut inside = simd.vectorize(
                #[inline(always)]
                || boxes_inside(simd, node, &walls),
            );
            while inside != 0 {
                let lane = inside.trailing_zeros() as usize;
                inside &= inside - 1;
                if node.count[lane] == 0 {
                    self.stack.push(node.first[lane]);
                } else {
                    let first = node.first[lane] as usize;
                    simd.vectorize(
                        #[inline(always)]
                        || self.meet_run(simd, scene, &shaft, first, node.count[lane]),
                    );
                }
            }
        }
        simd.vectorize(
            #[inline(always)]
            || self.hold_back(simd, scene),
        );
    }

    /// Takes what own triangles hold back off the list, and gives the rest their slots.
    #[inline(always)]
    fn hold_back<S: Simd>(&mut self, simd: S, scene: &Scene) {
        let mut kept = 0;
        self.patches.clear(scene.world.triangles.len());
        for place in 0..self.list.len {
            let triangle = scene.casters.id[self.list.slot[place] as usize];
            let verdict = self.own.judge(simd, &scene.world, &self.list, place, triangle);
            if verdict == Verdict::Never {
                self.patches.name(triangle, HELD_BACK);
            } else {
                self.patches.name(triangle, self.slots.len() as u32);
                self.patches.across.push([UNKNOWN; 3]);
                self.patches.seen.push([0; 2]);
                self.list.copy(place, kept);
                self.list.slot[kept] = self.slots.len() as u32;
                self.list.flags[kept] = if verdict == Verdict::Plain { 0 } else { MIXED };
                self.slots.push(Slot { triangle, verdict, is_sifted: false });
                self.shapes.push(Shape {
                    caster: self.list.caster(place),
                    edge_error: SEGMENT_SHARE * self.list.rows[9][place] + TINY,
                    plane_error: self.list.rows[10][place],
                });
                kept += 1;
            }
        }
        self.list.len = kept;
        self.patches.open_account(kept);
    }

    /// The shaft's sides in world space: inside is `normal . p <= limit`.
    fn walls(&self, shaft: &Shaft) -> [([f32; 3], f32); 6] {
        let [x, y, z] = self.frame.axes;
        let wall = |normal: [f32; 3], limit: f32| {
            let from = super::groups::dot(normal, self.frame.origin);
            // Unit lengths are below 2 in each coordinate.
            (normal, limit + from + 64.0 * f32::EPSILON * size(normal))
        };
        let axes = [x, y];
        let sides = [0, 1].map(|k| {
            let (upper, lower) = (shaft.upper[k], shaft.lower[k]);
            let tilted = |slope: f32| [0, 1, 2].map(|i| axes[k][i] - slope * z[i]);
            [wall(tilted(upper.slope), upper.limit), wall(tilted(lower.slope).map(|x| -x), -lower.limit)]
        });
        [
            sides[0][0],
            sides[0][1],
            sides[1][0],
            sides[1][1],
            wall(z, shaft.depth[1]),
            wall(z.map(|x| -x), -shaft.depth[0]),
        ]
    }

    /// Turns a run of casters into the cluster's space and keeps those that the shaft may meet.
    #[inline(always)]
    fn meet_run<S: Simd>(&mut self, simd: S, scene: &Scene, shaft: &Shaft, first: usize, count: u32) {
        let corner = &scene.casters.corner;
        let Frame { origin, axes } = self.frame;
        let a = [load(simd, &corner[0], first), load(simd, &corner[1], first), load(simd, &corner[2], first)];
        let g = [load(simd, &corner[3], first), load(simd, &corner[4], first), load(simd, &corner[5], first)];
        let h = [load(simd, &corner[6], first), load(simd, &corner[7], first), load(simd, &corner[8], first)];
        let a = turn(axes, from(a, origin));
        let (g, h) = (turn(axes, g), turn(axes, h));
        let (long_g, long_h) = (lengths(g), lengths(h));
        let long_b = lengths(minus(h, g));
        let reach = lengths(a) + long_g.max(long_h) + self.views.reach;
        let light = self.lights.reach + self.views.reach;
        let edge_error = (long_g.max(long_h).max(long_b) * reach).mul_add(EDGE_ERROR * light, TINY);
        let plane_error = (long_g * long_h * (reach + light)).mul_add(PLANE_ERROR, TINY);
        let far = reach.mul_add(CORNER_ERROR, TINY);
        let rows = [a[0], a[1], a[2], g[0], g[1], g[2], h[0], h[1], h[2], edge_error, plane_error, far];
        self.list.reserve(LANES);
        let place = self.list.len;
        let slot = u32x16::from_slice(simd, &PLACES) + first as u32;
        self.list.push(simd, rows, slot, slot, u16::MAX);
        self.list.len = place;
        let lanes = lanes_from(count as usize);
        let answer = shaft.meet(simd, &self.list, place, lanes);
        self.list.push_from(simd, place, answer.open | answer.covers, slot);
    }

    /// Calls `write` with every view-sample that has blocked light samples, and the words of its mask.
    #[inline(always)]
    pub fn write<S: Simd>(&mut self, simd: S, mut write: impl FnMut(u32, &[u32])) {
        self.places.resize(self.lights.count, 0);
        for (place, index) in (0u32..).zip(&self.lights.index[..self.lights.count]) {
            self.places[*index as usize] = place;
        }
        let length = self.lights.count.div_ceil(WORD);
        self.words.resize(LANES * length, 0);
        for (block, masks) in self.masks.chunks_exact((self.lights.root().last * LANES).max(1)).enumerate() {
            let mut some = masks.iter().fold(0, |some, bits| some | *bits);
            if some == 0 {
                continue;
            }
            for (at, places) in self.places.chunks(WORD).enumerate() {
                let mut row = [0u16; WORD];
                for (bits, place) in row.iter_mut().zip(places) {
                    *bits = masks[*place as usize];
                }
                let row = u16x32::from_slice(simd, &row);
                for lane in 0..LANES {
                    self.words[lane * length + at] = (row & (1 << lane)).simd_ne(0).to_bitmask() as u32;
                }
            }
            let first = block * LANES;
            some &= lanes_from(self.views.count - first);
            for (lane, words) in self.words.chunks_exact(length).enumerate() {
                if some >> lane & 1 == 1 {
                    write(self.views.index[first + lane], words);
                }
            }
        }
    }
}

/// Light samples of a word of a mask.
const WORD: usize = u32::BITS as usize;

/// From the scene's axes to a cluster's.
#[inline(always)]
fn turn<S: Simd>(axes: [[f32; 3]; 3], v: Vector<S>) -> Vector<S> {
    [dot_one(axes[0], v), dot_one(axes[1], v), dot_one(axes[2], v)]
}

/// Lengths, not less.
#[inline(always)]
fn lengths<S: Simd>(v: Vector<S>) -> f32x16<S> {
    dot(v, v).sqrt() * (1.0 + 1e-6)
}

const PLACES: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// Boxes of `node` that no wall leaves out.
#[inline(always)]
fn boxes_inside<S: Simd>(simd: S, node: &Node, walls: &[([f32; 3], f32); 6]) -> u32 {
    let mut inside = node.used as u16;
    for (normal, limit) in walls {
        let x = load(simd, if normal[0] > 0.0 { &node.low[0] } else { &node.high[0] }, 0);
        let y = load(simd, if normal[1] > 0.0 { &node.low[1] } else { &node.high[1] }, 0);
        let z = load(simd, if normal[2] > 0.0 { &node.low[2] } else { &node.high[2] }, 0);
        inside &= dot_one(*normal, [x, y, z]).simd_le(*limit).to_bitmask() as u16;
    }
    u32::from(inside)
}
