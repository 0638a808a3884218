//! Casters in runs of up to sixteen, in a tree of up to sixteen boxes a node.
//!
//! obvhs decides which triangles are neighbours; boxes are made here from the corners' own bits. All lengths are scaled by a
//! power of two that brings the largest coordinate to 1..2 and rounds nothing but what is 2^-126 of it.

use super::LANES;
use crate::shared::bvh::topology;
use crate::shared::predicate::Corners;
use obvhs::bvh2::Bvh2;
use rayon::prelude::*;

/// Boxes given to obvhs grow by this; it only steers the tree.
const WIDEN: f32 = 1e-6;

/// Up to sixteen boxes, lane by lane.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub struct Node {
    /// Smallest coordinates, axis by axis.
    pub low: [[f32; LANES]; 3],
    /// Largest coordinates.
    pub high: [[f32; LANES]; 3],
    /// Inner: a node. Run: its first place.
    pub first: [u32; LANES],
    /// Inner: 0. Run: its triangles.
    pub count: [u32; LANES],
    /// Lanes in use.
    pub used: u32,
}

/// All casters.
pub struct Casters {
    /// Nodes; the first is the root. Empty when nothing casts.
    pub nodes: Vec<Node>,
    /// By place: first corner, then the edges from it to the second and third corner; padded by sixteen zeros.
    pub corner: [Vec<f32>; 9],
    /// Triangle at each place; padded.
    pub id: Vec<u32>,
}

type Box3 = ([f32; 3], [f32; 3]);

fn join(a: Box3, b: Box3) -> Box3 {
    ([0, 1, 2].map(|k| a.0[k].min(b.0[k])), [0, 1, 2].map(|k| a.1[k].max(b.1[k])))
}

fn area((low, high): Box3) -> f32 {
    let [x, y, z] = [0, 1, 2].map(|k| high[k] - low[k]);
    x * y + y * z + z * x
}

/// A power of two that brings the largest coordinate to 1..2.
pub fn unit_scale<'a>(points: impl Iterator<Item = &'a [f32; 3]>) -> f64 {
    let largest = points.flatten().filter(|x| x.is_finite()).fold(0.0f32, |largest, x| largest.max(x.abs()));
    if largest > 0.0 { 2f64.powi(-(f64::from(largest).log2().floor() as i32)) } else { 1.0 }
}

impl Casters {
    /// Those of `triangles` that `casts` keeps and whose coordinates are finite, scaled.
    pub fn build(triangles: &[Corners], casts: impl Fn(usize) -> bool, scale: f64) -> Self {
        let usable = |id: usize| casts(id) && triangles[id].iter().flatten().all(|x| x.is_finite());
        let kept: Vec<u32> = (0..triangles.len()).filter(|&id| usable(id)).map(|id| id as u32).collect();
        let unit = |p: [f32; 3]| p.map(|x| (f64::from(x) * scale) as f32);
        let units: Vec<Corners> = kept.par_iter().map(|&id| triangles[id as usize].map(unit)).collect();
        let tree = topology(&units, WIDEN);
        let order: Vec<u32> = tree.primitive_indices.clone();
        let mut casters = Self { nodes: Vec::new(), corner: Default::default(), id: Vec::new() };
        if order.is_empty() {
            return casters;
        }
        let shape = Shape::new(&tree, &units);
        let places = casters.make_nodes(&tree, &shape);
        casters.id = places.iter().map(|&place| kept[order[place as usize] as usize]).collect();
        let padded = places.len() + LANES;
        casters.id.resize(padded, u32::MAX);
        casters.corner.par_iter_mut().enumerate().for_each(|(row, values)| {
            values.reserve(padded);
            values.extend(places.iter().map(|&place| {
                let corners = &units[order[place as usize] as usize];
                let first = corners[0][row % 3];
                if row < 3 { first } else { corners[row / 3][row % 3] - first }
            }));
            values.resize(padded, 0.0);
        });
        casters
    }

    /// Makes the nodes; answers obvhs's places in the order of runs.
    fn make_nodes(&mut self, tree: &Bvh2, shape: &Shape) -> Vec<u32> {
        let mut places = Vec::with_capacity(tree.primitive_indices.len());
        let mut open = vec![(0u32, 0usize)];
        self.nodes.push(Node::EMPTY);
        let is_run = |node: u32| shape.count[node as usize] <= LANES as u32;
        while let Some((from, to)) = open.pop() {
            // The widest child is taken apart until the node is full.
            let mut children = vec![from];
            while children.len() < LANES {
                let divisible = |node: &u32| !is_run(*node) && !tree.nodes[*node as usize].is_leaf();
                let widest = (0..children.len())
                    .filter(|&at| divisible(&children[at]))
                    .max_by(|&a, &b| shape.area(children[a]).total_cmp(&shape.area(children[b])));
                let Some(at) = widest else { break };
                let first = tree.nodes[children[at] as usize].first_index;
                children[at] = first;
                children.push(first + 1);
            }
            for (lane, &child) in children.iter().enumerate() {
                let count = shape.count[child as usize];
                let (low, high) = shape.bounds[child as usize];
                let first = if is_run(child) {
                    let first = places.len() as u32;
                    shape.run(tree, child, &mut places);
                    first
                } else {
                    open.push((child, self.nodes.len()));
                    self.nodes.push(Node::EMPTY);
                    self.nodes.len() as u32 - 1
                };
                let node = &mut self.nodes[to];
                for axis in 0..3 {
                    (node.low[axis][lane], node.high[axis][lane]) = (low[axis], high[axis]);
                }
                node.first[lane] = first;
                node.count[lane] = if is_run(child) { count } else { 0 };
                node.used |= 1 << lane;
            }
        }
        places
    }
}

impl Node {
    const EMPTY: Self =
        Self { low: [[0.0; LANES]; 3], high: [[0.0; LANES]; 3], first: [0; LANES], count: [0; LANES], used: 0 };
}

/// Triangles and boxes under every node of obvhs's tree.
struct Shape {
    count: Vec<u32>,
    bounds: Vec<Box3>,
}

impl Shape {
    fn new(tree: &Bvh2, units: &[Corners]) -> Self {
        let mut shape = Self { count: vec![0; tree.nodes.len()], bounds: vec![([0.0; 3], [0.0; 3]); tree.nodes.len()] };
        // Parents before children, walked from the back.
        let (mut order, mut at) = (vec![0u32], 0);
        while at < order.len() {
            let node = &tree.nodes[order[at] as usize];
            if !node.is_leaf() {
                order.extend([node.first_index, node.first_index + 1]);
            }
            at += 1;
        }
        for &index in order.iter().rev() {
            let node = &tree.nodes[index as usize];
            let first = node.first_index as usize;
            let (count, bounds) = if node.is_leaf() {
                let leaf = &tree.primitive_indices[first..first + node.prim_count as usize];
                let corners = leaf.iter().flat_map(|&place| units[place as usize]).map(|p| (p, p));
                (node.prim_count, corners.reduce(join).unwrap_or_default())
            } else {
                let bounds = join(shape.bounds[first], shape.bounds[first + 1]);
                (shape.count[first] + shape.count[first + 1], bounds)
            };
            (shape.count[index as usize], shape.bounds[index as usize]) = (count, bounds);
        }
        shape
    }

    fn area(&self, node: u32) -> f32 {
        area(self.bounds[node as usize])
    }

    /// Adds the places under `node`, of which there are few.
    fn run(&self, tree: &Bvh2, node: u32, places: &mut Vec<u32>) {
        let node = &tree.nodes[node as usize];
        if node.is_leaf() {
            places.extend(node.first_index..node.first_index + node.prim_count);
        } else {
            self.run(tree, node.first_index, places);
            self.run(tree, node.first_index + 1, places);
        }
    }
}
