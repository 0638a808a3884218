//! One cluster: gathers casters, divides its shaft until every part is decided.

use super::LANES;
use super::candidates::Candidates;
use super::groups::{Blocks, Frame, LightBox, Range, Slanted, every, size, tree_len};
use super::leaf::{Pair, test};
use super::own::{OwnPlanes, Verdict, World};
use super::shaft::{CORNER_ERROR, EDGE_ERROR, PLANE_ERROR, Shaft, TINY};
use super::tree::{Casters, Node};
use crate::shared::predicate::blocks;
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16, u32x16};

/// What a cluster reads.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// Triangles and lights as they came.
    pub world: World<'a>,
    /// Casters.
    pub casters: &'a Casters,
    /// View-samples.
    pub position: &'a [[f32; 3]],
    /// Triangle of each.
    pub triangle: &'a [u32],
    /// Light samples, scaled.
    pub lights: &'a [[f32; 3]],
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
    /// (caster, shaft) pairs looked at on the way.
    pub met: u64,
    /// (caster, leaf) pairs tested segment by segment.
    pub tested: u64,
    /// Segments that the exact predicate decided for one caster.
    pub exact: u64,
}

impl Counts {
    /// Sums.
    pub fn add(&mut self, other: &Self) {
        self.shafts += other.shafts;
        self.lit += other.lit;
        self.covered += other.covered;
        self.met += other.met;
        self.tested += other.tested;
        self.exact += other.exact;
    }
}

/// A caster of the cluster.
#[derive(Clone, Copy)]
struct Slot {
    triangle: u32,
    verdict: Verdict,
}

/// What a thread keeps from cluster to cluster.
#[derive(Default)]
pub struct Worker {
    points: Vec<[f32; 3]>,
    frame: Frame,
    views: Blocks,
    lights: Blocks,
    slanted: Vec<Slanted>,
    boxes: Vec<LightBox>,
    list: Candidates,
    slots: Vec<Slot>,
    own: OwnPlanes,
    stack: Vec<u32>,
    pairs: Vec<(usize, Pair)>,
    /// A bit a light sample of a block, for each view-sample by place and each block.
    masks: Vec<u16>,
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
        self.views.fill(self.points.iter().zip(rows).map(|(point, row)| (frame.point(*point), *row)));
        self.lights.fill(scene.lights.iter().zip(0..).map(|(point, index)| (frame.point(*point), index)));
        let (views, lights) = (self.views.root(), self.lights.root());
        self.slanted.resize(tree_len(views.last), Slanted::default());
        every(views, &mut |range| self.slanted[range.node] = self.views.slanted(range));
        self.boxes.resize(tree_len(lights.last), LightBox::default());
        every(lights, &mut |range| self.boxes[range.node] = self.lights.light_box(range));
        self.masks.clear();
        self.masks.resize(views.last * LANES * lights.last, 0);
        let owns = self.views.index[..self.views.count].iter().map(|&row| scene.triangle[row as usize]);
        self.own.gather(&scene.world, &frame, owns, (self.boxes[0].low, self.boxes[0].high));
        self.list.len = 0;
        self.gather(simd, scene);
        if self.list.len > 0 {
            self.divide(simd, scene, views, lights, 0);
        } else {
            self.counts.lit += 1;
        }
    }

    /// Puts every caster that may matter on the list.
    fn gather<S: Simd>(&mut self, simd: S, scene: &Scene) {
        let shaft = Shaft::new(self.slanted[0], self.boxes[0]);
        let walls = self.walls(&shaft);
        self.slots.clear();
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
        // What the own triangles let through; the rest leaves the list.
        let mut kept = 0;
        for place in 0..self.list.len {
            let triangle = scene.casters.id[self.list.slot[place] as usize];
            let verdict = self.own.judge(&scene.world, &self.list, place, triangle);
            if verdict != Verdict::Never {
                self.list.copy(place, kept);
                self.list.slot[kept] = self.slots.len() as u32;
                self.slots.push(Slot { triangle, verdict });
                kept += 1;
            }
        }
        self.list.len = kept;
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
        let row = |k: usize| f32x16::from_slice(simd, &scene.casters.corner[k][first..first + LANES]);
        let Frame { origin, axes } = self.frame;
        let turn = |v: [f32x16<S>; 3]| axes.map(|axis| v[0].mul_add(axis[0], v[1].mul_add(axis[1], v[2] * axis[2])));
        let a = turn([row(0) - origin[0], row(1) - origin[1], row(2) - origin[2]]);
        let (g, h) = (turn([row(3), row(4), row(5)]), turn([row(6), row(7), row(8)]));
        let size = |v: [f32x16<S>; 3]| v[0].abs() + v[1].abs() + v[2].abs();
        let (size_g, size_h) = (size(g), size(h));
        let reach = size(a) + size_g + size_h + self.views.reach;
        let light = self.lights.reach + self.views.reach;
        let edge_error = ((size_g + size_h) * reach).mul_add(EDGE_ERROR * light, TINY);
        let plane_error = (size_g * size_h * (reach + light)).mul_add(PLANE_ERROR, TINY);
        let far = reach.mul_add(CORNER_ERROR, TINY);
        let rows = [a[0], a[1], a[2], g[0], g[1], g[2], h[0], h[1], h[2], edge_error, plane_error, far];
        self.list.reserve(LANES);
        let place = self.list.len;
        let slot = u32x16::from_slice(simd, &PLACES) + first as u32;
        self.list.push(simd, rows, slot, u16::MAX);
        self.list.len = place;
        let lanes = ((1u32 << count) - 1) as u16;
        let answer = shaft.meet(simd, &self.list, place, lanes);
        self.list.push_from(simd, place, answer.open | answer.covers);
    }

    /// Decides the shaft from `views` to `lights`, whose candidates are those from `start` on; they are still there afterwards.
    fn divide<S: Simd>(&mut self, simd: S, scene: &Scene, views: Range, lights: Range, start: usize) {
        self.counts.shafts += 1;
        let end = self.list.len;
        self.counts.met += (end - start) as u64;
        let shaft = Shaft::new(self.slanted[views.node], self.boxes[lights.node]);
        if views.len() == 1 && lights.len() == 1 {
            simd.vectorize(
                #[inline(always)]
                || self.leaf(simd, scene, &shaft, views.first, lights.first, start),
            );
            return;
        }
        let narrowed = simd.vectorize(
            #[inline(always)]
            || self.narrow(simd, &shaft, start),
        );
        let Some(views_wider) = narrowed else {
            self.counts.covered += 1;
            self.fill(views, lights);
            self.list.len = end;
            return;
        };
        let left = self.list.len - end;
        if left == 0 {
            self.counts.lit += 1;
            return;
        }
        let by_views = lights.len() == 1 || (views.len() > 1 && 2 * views_wider > left);
        if by_views {
            for half in views.halves() {
                self.divide(simd, scene, half, lights, end);
            }
        } else {
            for half in lights.halves() {
                self.divide(simd, scene, views, half, end);
            }
        }
        self.list.len = end;
    }

    /// Puts the candidates from `start` on that stay open on the stack once more; how many are wider through the view-samples.
    /// None when one covers the shaft.
    #[inline(always)]
    fn narrow<S: Simd>(&mut self, simd: S, shaft: &Shaft, start: usize) -> Option<usize> {
        let end = self.list.len;
        self.list.reserve(end - start + LANES);
        let mut views_wider = 0;
        for place in (start..end).step_by(LANES) {
            let lanes = lanes_from(end - place);
            let answer = shaft.meet(simd, &self.list, place, lanes);
            let mut keep = answer.open;
            if answer.covers != 0 {
                if self.covers(place, answer.covers) {
                    return None;
                }
                keep |= answer.covers;
            }
            if keep != 0 {
                self.list.push_from(simd, place, keep);
                views_wider += answer.views_wider.count_ones() as usize;
            }
        }
        Some(views_wider)
    }

    /// Whether one of `lanes` blocks for every view-sample that it covers.
    fn covers(&self, place: usize, lanes: u16) -> bool {
        (0..LANES).any(|lane| {
            lanes >> lane & 1 == 1 && self.slots[self.list.slot[place + lane] as usize].verdict == Verdict::Plain
        })
    }

    fn fill(&mut self, views: Range, lights: Range) {
        let blocks = self.lights.root().last;
        for view in views.first * LANES..views.last * LANES {
            self.masks[view * blocks + lights.first..view * blocks + lights.last].fill(u16::MAX);
        }
    }

    /// Decides every segment from one block of view-samples to one of light samples.
    #[inline(always)]
    fn leaf<S: Simd>(&mut self, simd: S, scene: &Scene, shaft: &Shaft, view: usize, light: usize, start: usize) {
        let end = self.list.len;
        self.pairs.clear();
        for place in (start..end).step_by(LANES) {
            let answer = shaft.meet(simd, &self.list, place, lanes_from(end - place));
            if answer.covers != 0 && self.covers(place, answer.covers) {
                self.counts.covered += 1;
                let block = |first| Range { node: 0, first, last: first + 1 };
                self.fill(block(view), block(light));
                return;
            }
            let mut left = answer.open | answer.covers;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                let bit = |mask: u16| (mask >> lane & 1) as u8;
                let edges = bit(answer.edge[0]) | bit(answer.edge[1]) << 1 | bit(answer.edge[2]) << 2;
                let side = bit(answer.from_below) as i8 - bit(answer.from_above) as i8;
                let place = place + lane;
                let pair = Pair {
                    caster: self.list.caster(place),
                    edge_error: self.list.rows[9][place],
                    plane_error: self.list.rows[10][place],
                    // An edge's sign means nothing while that of the plane is open.
                    edges: if side == 0 { 0b111 } else { edges },
                    side,
                };
                self.pairs.push((place, pair));
            }
        }
        if self.pairs.is_empty() {
            self.counts.lit += 1;
            return;
        }
        let views = view * LANES;
        let lights = light * LANES;
        let view_points = self.views.at.each_ref().map(|along| &along[views..views + LANES]);
        let light_points = self.lights.at.each_ref().map(|along| &along[lights..lights + LANES]);
        let mut blocked = [0u16; LANES];
        for (place, pair) in &self.pairs {
            self.counts.tested += 1;
            let mut found = test(simd, view_points, light_points, pair);
            let slot = self.slots[self.list.slot[*place] as usize];
            if let Verdict::Mixed(row) = slot.verdict {
                let order = &self.lights.index[lights..lights + LANES];
                let allowed = self.own.allowed(&scene.world, row, views, order);
                for j in 0..LANES {
                    found.sure[j] &= allowed[j];
                    found.may[j] &= allowed[j];
                }
            }
            let (mut full, mut doubt) = (u16::MAX, 0);
            for j in 0..LANES {
                blocked[j] |= found.sure[j];
                found.may[j] &= !blocked[j];
                full &= blocked[j];
                doubt |= found.may[j];
            }
            if doubt != 0 {
                for (j, may) in found.may.iter().enumerate() {
                    let light = scene.world.lights[self.lights.index[lights + j] as usize];
                    for lane in (0..LANES).filter(|lane| may >> lane & 1 == 1) {
                        self.counts.exact += 1;
                        let row = self.views.index[views + lane] as usize;
                        let own = scene.world.triangles.get(scene.triangle[row] as usize);
                        let caster = &scene.world.triangles[slot.triangle as usize];
                        let is_blocked =
                            scene.triangle[row] != slot.triangle && blocks(scene.position[row], own, caster, light);
                        blocked[j] |= u16::from(is_blocked) << lane;
                    }
                }
            }
            if full == u16::MAX {
                break;
            }
        }
        let blocks = self.lights.root().last;
        for lane in 0..LANES {
            let bits = (0..LANES).fold(0, |bits, j| bits | (blocked[j] >> lane & 1) << j);
            self.masks[(views + lane) * blocks + light] = bits;
        }
    }

    /// Calls `write` with every view-sample that has blocked light samples, and the words of its mask.
    pub fn write(&self, words: &mut [u32], mut write: impl FnMut(u32, &[u32])) {
        let blocks = self.lights.root().last;
        let count = self.lights.count;
        for (view, masks) in self.masks.chunks_exact(blocks.max(1)).enumerate().take(self.views.count) {
            if masks.iter().all(|bits| *bits == 0) {
                continue;
            }
            words.fill(0);
            if masks.iter().all(|bits| *bits == u16::MAX) {
                words.fill(u32::MAX);
                if !count.is_multiple_of(32) {
                    words[count / 32] = (1 << (count % 32)) - 1;
                }
            } else {
                for (bits, order) in masks.iter().zip(self.lights.index.chunks_exact(LANES)) {
                    let mut bits = *bits;
                    while bits != 0 {
                        let index = order[bits.trailing_zeros() as usize];
                        bits &= bits - 1;
                        words[index as usize / 32] |= 1 << (index % 32);
                    }
                }
            }
            write(self.views.index[view], words);
        }
    }
}

const PLACES: [u32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The first `count` of sixteen.
fn lanes_from(count: usize) -> u16 {
    if count >= LANES { u16::MAX } else { (1 << count) - 1 }
}

/// Boxes of `node` that no wall leaves out.
#[inline(always)]
fn boxes_inside<S: Simd>(simd: S, node: &Node, walls: &[([f32; 3], f32); 6]) -> u32 {
    let mut inside = node.used as u16;
    for (normal, limit) in walls {
        let nearest = |axis: usize| {
            let ends = if normal[axis] > 0.0 { &node.low[axis] } else { &node.high[axis] };
            f32x16::from_slice(simd, ends)
        };
        let height = nearest(0).mul_add(normal[0], nearest(1).mul_add(normal[1], nearest(2) * normal[2]));
        inside &= height.simd_le(*limit).to_bitmask() as u16;
    }
    u32::from(inside)
}
