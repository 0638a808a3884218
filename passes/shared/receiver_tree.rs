//! Order in long lists: a tree of boxes over the view-samples of a cell that holds too many to test one by one.
//!
//! Lists are short where light texels match the view's density; where they do not (the camera zoomed in, few texels, all of the view in
//! one texel) a caster would be tested against everything. Such a list is put in order by halving it at the median of its longer
//! side, as Aila and Laine's tree does (2004, section 3), and casters walk the boxes: outside a plane, beside the caster's own box, or
//! wholly blocked, a box is passed over.

use super::pyramid::{LightSpace, Planes};
use super::receivers::{LANES, Receivers, Settle};
use fearless_simd::Simd;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Lists longer than this get a tree.
pub const LONG: usize = 1024;
/// View-samples in a leaf at most, about: halving ends below it.
const LEAF: usize = 8 * LANES;
/// Lists longer than this are halved in parallel.
const SHARED: usize = 1 << 15;

/// u, v and who.
type Place = ([f32; 2], u32);

/// A box of view-samples.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Smallest and largest u, then v.
    ends: [[f32; 2]; 2],
    /// Smallest reciprocal depth.
    far: f32,
    /// First and last but one place.
    places: [u32; 2],
    /// The node after this one's subtree.
    next: u32,
    /// The node above; its own index for a root.
    parent: u32,
}

/// Trees of all long lists.
#[derive(Default)]
pub struct Trees {
    /// Cell and root, in the order of cells.
    roots: Vec<(u32, u32)>,
    nodes: Vec<Node>,
    /// View-samples below each node that are not blocked yet; neighbours tested in passing are not taken off.
    open: Vec<AtomicU32>,
}

/// Where to halve the places `[from, to)`: at a chunk's border. None for a leaf.
fn middle([from, to]: [usize; 2]) -> Option<usize> {
    (to - from > LEAF).then(|| (from + (to - from) / 2).next_multiple_of(LANES))
}

/// Cells of `offsets` whose lists are long.
pub fn long_lists(offsets: &[u32]) -> Vec<usize> {
    let is_long = |cell: &usize| (offsets[cell + 1] - offsets[*cell]) as usize > LONG;
    (0..offsets.len().saturating_sub(1)).into_par_iter().with_min_len(1 << 14).filter(is_long).collect()
}

/// Puts a long list that starts at place `from` in order.
pub fn order(list: &mut [u32], from: usize, space: &LightSpace, positions: &[[f32; 3]]) {
    let place = |sample: &u32| {
        let (spot, tame) = space.project(positions[*sample as usize]);
        (if tame { [spot.u, spot.v] } else { [0.0; 2] }, *sample)
    };
    let mut places: Vec<Place> = list.par_iter().with_min_len(1 << 12).map(place).collect();
    halve(&mut places, from);
    for (entry, (_, sample)) in list.iter_mut().zip(&places) {
        *entry = *sample;
    }
}

fn halve(places: &mut [Place], from: usize) {
    let Some(at) = middle([from, from + places.len()]) else {
        return;
    };
    let mut extent = [0.0; 2];
    for (axis, extent) in extent.iter_mut().enumerate() {
        let along = places.iter().map(|(at, _)| at[axis]);
        let (low, high) = along.fold((f32::MAX, f32::MIN), |(low, high), x| (low.min(x), high.max(x)));
        *extent = high - low;
    }
    let axis = usize::from(extent[1] > extent[0]);
    places.select_nth_unstable_by(at - from, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    let (left, right) = places.split_at_mut(at - from);
    if left.len() > SHARED {
        rayon::join(|| halve(left, from), || halve(right, at));
    } else {
        halve(left, from);
        halve(right, at);
    }
}

impl Trees {
    /// Over the lists of `cells`, given with their first and last but one place, in order.
    pub fn new(receivers: &Receivers, cells: &[(usize, [usize; 2])]) -> Self {
        let build = |(cell, places): &(usize, [usize; 2])| {
            let mut nodes = Vec::new();
            grow(receivers, &mut nodes, *places, 0);
            (*cell, nodes)
        };
        let parts: Vec<_> = cells.par_iter().map(build).collect();
        let mut trees = Self::default();
        for (cell, nodes) in parts {
            let shift = trees.nodes.len() as u32;
            trees.roots.push((cell as u32, shift));
            let shifted =
                |(node, _): &(Node, u32)| Node { next: node.next + shift, parent: node.parent + shift, ..*node };
            trees.nodes.extend(nodes.iter().map(shifted));
            trees.open.extend(nodes.iter().map(|(_, open)| AtomicU32::new(*open)));
        }
        trees
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Cells from `first` to `last` that have trees, with their roots.
    pub fn between(&self, first: usize, last: usize) -> &[(u32, u32)] {
        let at = |cell: usize| self.roots.partition_point(|(other, _)| (*other as usize) < cell);
        &self.roots[at(first)..at(last + 1)]
    }

    /// Whether every view-sample of `root` was found blocked.
    pub fn is_full(&self, root: u32) -> bool {
        self.open[root as usize].load(Relaxed) == 0
    }

    /// Tests the view-samples of the tree at `root` that `planes` may cover and that lie in `bounds` (smallest and largest u,
    /// then v).
    #[inline(always)]
    pub fn test<S: Simd>(
        &self,
        simd: S,
        receivers: &Receivers,
        root: u32,
        planes: &Planes,
        bounds: &[[f32; 2]; 2],
        settle: &mut Settle,
    ) {
        let mut at = root as usize;
        let end = self.nodes[at].next as usize;
        while at < end {
            let node = &self.nodes[at];
            if self.open[at].load(Relaxed) == 0 || node.is_outside(planes, bounds) {
                at = node.next as usize;
                continue;
            }
            if node.next as usize == at + 1 {
                let tested = receivers.test_run(simd, node.places.map(|place| place as usize), planes, settle);
                if tested.hits > 0 {
                    self.take(at, tested.hits);
                }
            }
            at += 1;
        }
    }

    /// Takes `hits` view-samples off the node at `at` and all above.
    fn take(&self, mut at: usize, hits: u32) {
        loop {
            self.open[at].fetch_sub(hits, Relaxed);
            let parent = self.nodes[at].parent as usize;
            if parent == at {
                return;
            }
            at = parent;
        }
    }
}

impl Node {
    #[inline(always)]
    fn is_outside(&self, planes: &Planes, bounds: &[[f32; 2]; 2]) -> bool {
        let [u, v] = self.ends;
        let beside = (bounds[0][0] > u[1]) | (bounds[0][1] < u[0]) | (bounds[1][0] > v[1]) | (bounds[1][1] < v[0]);
        // Bounds on rounding do not care which u and v in reach they are applied to, so corners of a box serve.
        let largest = |k: usize| {
            (planes.u[k] * u[0]).max(planes.u[k] * u[1]) + (planes.v[k] * v[0]).max(planes.v[k] * v[1]) + planes.one[k]
        };
        beside | (largest(0) < 0.0) | (largest(1) < 0.0) | (largest(2) < 0.0) | (largest(3) + planes.q * self.far < 0.0)
    }
}

/// Nodes over `places` behind those in `nodes`, each with the number of its view-samples.
fn grow(receivers: &Receivers, nodes: &mut Vec<(Node, u32)>, places: [usize; 2], parent: usize) {
    let index = nodes.len();
    let places_u32 = places.map(|place| place as u32);
    let empty = [[f32::MAX, f32::MIN]; 2];
    let node = Node { ends: empty, far: f32::MAX, places: places_u32, next: 0, parent: parent as u32 };
    nodes.push((node, 0));
    if let Some(at) = middle(places) {
        grow(receivers, nodes, [places[0], at], index);
        let right = nodes.len();
        grow(receivers, nodes, [at, places[1]], index);
        let children = [nodes[index + 1], nodes[right]];
        let (node, open) = &mut nodes[index];
        for (child, count) in children {
            for (ends, other) in node.ends.iter_mut().zip(child.ends) {
                *ends = [ends[0].min(other[0]), ends[1].max(other[1])];
            }
            node.far = node.far.min(child.far);
            *open += count;
        }
    } else {
        let (node, open) = &mut nodes[index];
        for place in places[0]..places[1] {
            if let Some(spot) = receivers.spot(place) {
                for (ends, x) in node.ends.iter_mut().zip([spot.u, spot.v]) {
                    *ends = [ends[0].min(x), ends[1].max(x)];
                }
                node.far = node.far.min(spot.q);
                *open += 1;
            }
        }
    }
    nodes[index].0.next = nodes.len() as u32;
}

/// Bounds that leave nothing out.
pub const EVERYWHERE: [[f32; 2]; 2] = [[f32::MIN, f32::MAX]; 2];

#[cfg(test)]
#[path = "receiver_tree_tests.rs"]
mod tests;
