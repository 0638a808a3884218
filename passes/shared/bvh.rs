//! A binary tree of boxes over triangles, and a walk along a segment that may visit too many triangles but never too few.
//!
//! obvhs decides the tree; the boxes are made here from the corners' own bits, so no scaling of obvhs's input can lose one.

use crate::shared::threaded::{END, LEAF_BITS, NODE_WORDS, SKIP};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// Relative error of one slab distance in f64 (a subtraction of each operand pair, a reciprocal, a product: under 2^-50), doubled.
const SLAB_ERROR: f64 = 1.0 / (1u64 << 49) as f64;

/// Deepest tree that is still improved by reinsertion, whose own stack is fixed.
const REINSERTION_DEPTH: usize = 64;

/// Most triangles of a leaf.
const LEAF_TRIANGLES: u32 = 4;

/// Inner node: `count` 0, children `first` and `first + 1`. Leaf: triangles `first..first + count` of the order.
#[derive(Clone, Copy, Default)]
struct Node {
    low: [f32; 3],
    first: u32,
    high: [f32; 3],
    count: u32,
}

/// The tree. Boxes are the exact bounds of their triangles, one f32 step wider on every side, so that a segment which only
/// touches a triangle's bound never meets the undefined product of zero and infinity.
#[derive(Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

/// Memory of a walk, kept from one to the next.
#[derive(Default)]
pub struct Walk {
    stack: Vec<u32>,
}

impl Bvh {
    /// A tree over the triangles that `casts` keeps. Triangles with a coordinate that is not finite are left out: no
    /// predicate can be decided on them.
    pub fn build(triangles: &[[[f32; 3]; 3]], casts: impl Fn(usize) -> bool) -> Self {
        let usable = |id: usize| casts(id) && triangles[id].iter().flatten().all(|x| x.is_finite());
        let kept: Vec<u32> = (0..triangles.len()).filter(|&id| usable(id)).map(|id| id as u32).collect();
        if kept.is_empty() {
            return Self::default();
        }
        let (low, high) = bounds(kept.iter().flat_map(|&id| triangles[id as usize]));
        let extent = [0, 1, 2].map(|k| f64::from(high[k]) - f64::from(low[k]));
        let extent = extent.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let unit = |p: [f32; 3]| [0, 1, 2].map(|k| ((f64::from(p[k]) - f64::from(low[k])) / extent) as f32);
        let unit_triangles: Vec<_> = kept.iter().map(|&id| triangles[id as usize].map(unit)).collect();
        let tree = topology(&unit_triangles, 1e-6);
        let order: Vec<u32> = tree.primitive_indices.iter().map(|&place| kept[place as usize]).collect();
        // Copied in an order with parents before children, so that boxes can be made from the back.
        let mut nodes = vec![Node::default(); tree.nodes.len()];
        let (mut next, mut open) = (1, vec![(0usize, 0usize)]);
        while let Some((from, to)) = open.pop() {
            let source = &tree.nodes[from];
            if source.is_leaf() {
                nodes[to] = Node { first: source.first_index, count: source.prim_count, ..Node::default() };
            } else {
                nodes[to] = Node { first: next, ..Node::default() };
                open.push((source.first_index as usize + 1, next as usize + 1));
                open.push((source.first_index as usize, next as usize));
                next += 2;
            }
        }
        for index in (0..nodes.len()).rev() {
            let Node { first, count, .. } = nodes[index];
            let (low, high) = if count > 0 {
                let leaf = &order[first as usize..(first + count) as usize];
                let (low, high) = bounds(leaf.iter().flat_map(|&id| triangles[id as usize]));
                (low.map(f32::next_down), high.map(f32::next_up))
            } else {
                let (a, b) = (nodes[first as usize], nodes[first as usize + 1]);
                ([0, 1, 2].map(|k| a.low[k].min(b.low[k])), [0, 1, 2].map(|k| a.high[k].max(b.high[k])))
            };
            (nodes[index].low, nodes[index].high) = (low, high);
        }
        Self { nodes, order }
    }

    /// Triangles in the order of the leaves.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The nodes depth first, each with its way on: what passes that walk the tree on either backend share, as
    /// [`crate::shared::threaded`] tells.
    pub fn threaded(&self) -> Vec<[u32; NODE_WORDS]> {
        let mut threaded: Vec<[u32; NODE_WORDS]> = Vec::with_capacity(self.nodes.len().max(1));
        let words = |node: &Node, leaf: u32| {
            let (low, high) = (node.low.map(f32::to_bits), node.high.map(f32::to_bits));
            [low[0], low[1], low[2], END, high[0], high[1], high[2], leaf]
        };
        if self.nodes.is_empty() {
            return vec![words(&Node { low: [f32::MAX; 3], high: [f32::MAX; 3], ..Node::default() }, 0)];
        }
        // A node, and the inner node at whose end it stands: there its subtree's end is known.
        let mut open = vec![(0u32, Vec::new())];
        while let Some((index, mut ending)) = open.pop() {
            let node = &self.nodes[index as usize];
            let place = threaded.len();
            ending.push(place);
            threaded.push(words(node, (node.first << LEAF_BITS | node.count) * u32::from(node.count > 0)));
            if node.count == 0 {
                // The right child ends where its parents do.
                open.push((node.first + 1, ending));
                open.push((node.first, Vec::new()));
            } else if !open.is_empty() {
                let next = threaded.len() as u32;
                for place in ending {
                    threaded[place][SKIP] = next;
                }
            }
        }
        threaded
    }

    /// Smallest and largest coordinates of all its triangles, a step wider; zeros when there are none.
    pub fn extremes(&self) -> [[f32; 3]; 2] {
        let finite = |p: [f32; 3]| p.map(|x| x.clamp(f32::MIN, f32::MAX));
        self.nodes.first().map_or([[0.0; 3]; 2], |root| [finite(root.low), finite(root.high)])
    }

    /// Calls `visit` with every triangle that comes within `pad` (world units, along each axis) of the closed segment, and with
    /// some others, nearer boxes first, until `visit` answers true. Returns whether it did.
    pub fn along_segment(
        &self,
        walk: &mut Walk,
        from: [f32; 3],
        to: [f32; 3],
        pad: f64,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        let Some(root) = self.nodes.first() else { return false };
        let slabs = Slabs::new(from, to, pad);
        if slabs.enters(root).is_none() {
            return false;
        }
        walk.stack.clear();
        let mut node = root;
        loop {
            let next = if node.count > 0 {
                let leaf = &self.order[node.first as usize..(node.first + node.count) as usize];
                if leaf.iter().any(|&id| visit(id)) {
                    return true;
                }
                None
            } else {
                let (left, right) = (node.first, node.first + 1);
                match (slabs.enters(&self.nodes[left as usize]), slabs.enters(&self.nodes[right as usize])) {
                    (Some(a), Some(b)) => {
                        let (near, far) = if a <= b { (left, right) } else { (right, left) };
                        walk.stack.push(far);
                        Some(near)
                    }
                    (Some(_), None) => Some(left),
                    (None, Some(_)) => Some(right),
                    (None, None) => None,
                }
            };
            match next.or_else(|| walk.stack.pop()) {
                Some(index) => node = &self.nodes[index as usize],
                None => return false,
            }
        }
    }

    /// Calls `visit` with every triangle the ray meets no later than `visit` last answered, and with some others, nearer boxes
    /// first. `visit` answers the largest t of `from + t direction` still of interest.
    pub fn along_ray(&self, walk: &mut Walk, from: [f64; 3], direction: [f64; 3], mut visit: impl FnMut(u32) -> f64) {
        if self.nodes.is_empty() {
            return;
        }
        let slabs = Slabs { from, inverse: direction.map(|x| 1.0 / x), pad: 0.0 };
        let mut limit = f64::INFINITY;
        walk.stack.clear();
        walk.stack.push(0);
        while let Some(index) = walk.stack.pop() {
            let node = &self.nodes[index as usize];
            // Once more, as the limit may have fallen since the node was put away.
            if slabs.enters_before(node, limit).is_none() {
                continue;
            }
            if node.count > 0 {
                for &id in &self.order[node.first as usize..(node.first + node.count) as usize] {
                    limit = visit(id);
                }
                continue;
            }
            let children = [node.first, node.first + 1];
            match children.map(|child| slabs.enters_before(&self.nodes[child as usize], limit)) {
                [Some(a), Some(b)] if a <= b => walk.stack.extend([children[1], children[0]]),
                [Some(_), Some(_)] => walk.stack.extend(children),
                [Some(_), None] => walk.stack.push(children[0]),
                [None, Some(_)] => walk.stack.push(children[1]),
                [None, None] => {}
            }
        }
    }
}

/// A segment prepared for boxes.
struct Slabs {
    from: [f64; 3],
    inverse: [f64; 3],
    pad: f64,
}

impl Slabs {
    fn new(from: [f32; 3], to: [f32; 3], pad: f64) -> Self {
        let (from, to) = (from.map(f64::from), to.map(f64::from));
        Self { from, inverse: [0, 1, 2].map(|k| 1.0 / (to[k] - from[k])), pad }
    }

    /// Where the segment (0 at its start, 1 at its end) enters the box, or none if it certainly does not.
    #[inline(always)]
    fn enters(&self, node: &Node) -> Option<f64> {
        self.enters_before(node, 1.0)
    }

    /// The same for a segment that ends at `limit`.
    #[inline(always)]
    fn enters_before(&self, node: &Node, limit: f64) -> Option<f64> {
        let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
        for k in 0..3 {
            let a = (f64::from(node.low[k]) - self.pad - self.from[k]) * self.inverse[k];
            let b = (f64::from(node.high[k]) + self.pad - self.from[k]) * self.inverse[k];
            let (a, b) = if a <= b { (a, b) } else { (b, a) };
            near = if a > near { a } else { near };
            far = if b < far { b } else { far };
        }
        // Each distance is off by at most SLAB_ERROR of itself: the comparisons give way by that much.
        let (early, late) = (near - SLAB_ERROR * near.abs(), far + SLAB_ERROR * far.abs());
        (early <= late && late >= 0.0 && early <= limit).then_some(near)
    }
}

/// obvhs's tree over the boxes of triangles whose coordinates are about 1 (its areas overflow on 1e38 and vanish on 1e-30),
/// each box wider by once to twice `widen`, differently for each: equal boxes tie in its search for partners, which then
/// finds one pair in each round and takes the square of the time.
pub fn topology(unit_triangles: &[[[f32; 3]; 3]], widen: f32) -> Bvh2 {
    if unit_triangles.is_empty() {
        return Bvh2::zeroed(0);
    }
    let boxes: Vec<Aabb> = (0u32..)
        .zip(unit_triangles)
        .map(|(place, triangle)| {
            let (low, high) = bounds(triangle.iter().copied());
            let by = widen * (1.0 + place.wrapping_mul(0x9e37_79b9) as f32 / u32::MAX as f32);
            Aabb::new(low.map(|x| x - by).into(), high.map(|x| x + by).into())
        })
        .collect();
    let order = (0..boxes.len() as u32).collect();
    let mut tree =
        PlocBuilder::with_capacity(boxes.len()).build(PlocSearchDistance::Low, &boxes, order, SortPrecision::U64, 0);
    if depth(&tree) <= REINSERTION_DEPTH {
        ReinsertionOptimizer::default().run(&mut tree, 0.02, None);
    }
    collapse(&mut tree, LEAF_TRIANGLES, 1.5);
    tree.max_depth = tree.max_depth.max(depth(&tree) + 1);
    tree
}

/// Levels of a tree.
fn depth(tree: &Bvh2) -> usize {
    let (mut deepest, mut open) = (0, vec![(0u32, 1usize)]);
    while let Some((index, level)) = open.pop() {
        deepest = deepest.max(level);
        let node = &tree.nodes[index as usize];
        if !node.is_leaf() {
            open.extend([(node.first_index, level + 1), (node.first_index + 1, level + 1)]);
        }
    }
    deepest
}

/// Smallest and largest coordinates.
fn bounds(corners: impl Iterator<Item = [f32; 3]>) -> ([f32; 3], [f32; 3]) {
    corners.fold(([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]), |(low, high), p| {
        ([0, 1, 2].map(|k| low[k].min(p[k])), [0, 1, 2].map(|k| high[k].max(p[k])))
    })
}
