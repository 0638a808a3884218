//! Casters in runs of up to sixteen, in a tree of up to sixteen boxes a node.
//!
//! [`super::splits`] decides which triangles are neighbours; boxes are made of the corners' own bits. All lengths are scaled by a
//! power of two that brings the largest coordinate to 1..2 and rounds nothing but what is 2^-126 of it.

use super::LANES;
use super::splits::{Tree, divide};
use crate::shared::predicate::Corners;
use rayon::prelude::*;

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
        let mut casters = Self { nodes: Vec::new(), corner: Default::default(), id: Vec::new() };
        if units.is_empty() {
            return casters;
        }
        let (order, tree) = divide(&units, LANES);
        casters.make_nodes(&tree);
        let padded = order.len() + LANES;
        casters.id = order.iter().map(|&at| kept[at as usize]).collect();
        casters.id.resize(padded, u32::MAX);
        casters.corner.par_iter_mut().enumerate().for_each(|(row, values)| {
            values.reserve(padded);
            values.extend(order.iter().map(|&at| {
                let corners = &units[at as usize];
                let first = corners[0][row % 3];
                if row < 3 { first } else { corners[row / 3][row % 3] - first }
            }));
            values.resize(padded, 0.0);
        });
        casters
    }

    fn make_nodes(&mut self, tree: &Tree) {
        let mut open = vec![(tree, 0usize)];
        self.nodes.push(Node::EMPTY);
        while let Some((from, to)) = open.pop() {
            // The widest child is taken apart until the node is full.
            let mut children = vec![from];
            while children.len() < LANES {
                let widest = (0..children.len())
                    .filter(|&at| children[at].halves.is_some())
                    .max_by(|&a, &b| children[a].area().total_cmp(&children[b].area()));
                let Some((at, halves)) = widest.and_then(|at| Some((at, children[at].halves.as_deref()?))) else {
                    break;
                };
                children[at] = &halves[0];
                children.push(&halves[1]);
            }
            for (lane, child) in children.iter().enumerate() {
                let (first, count) = if child.halves.is_none() {
                    (child.first, child.count)
                } else {
                    open.push((child, self.nodes.len()));
                    self.nodes.push(Node::EMPTY);
                    (self.nodes.len() as u32 - 1, 0)
                };
                let node = &mut self.nodes[to];
                for axis in 0..3 {
                    (node.low[axis][lane], node.high[axis][lane]) = (child.bounds.0[axis], child.bounds.1[axis]);
                }
                (node.first[lane], node.count[lane]) = (first, count);
                node.used |= 1 << lane;
            }
        }
    }
}

impl Node {
    const EMPTY: Self =
        Self { low: [[0.0; LANES]; 3], high: [[0.0; LANES]; 3], first: [0; LANES], count: [0; LANES], used: 0 };
}
