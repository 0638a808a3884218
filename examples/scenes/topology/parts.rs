//! Connected parts and which of them are closed two-manifolds.
//!
//! Positions are welded where their numbers are equal. A part is closed when every edge has exactly two faces, which run
//! along it in opposite directions, and when it encloses a positive volume. Light-back-facing triangles alone then decide
//! its shadows on every view-sample outside of it: a segment from outside to anywhere enters it at least as often through
//! them as it leaves it. Inside-out parts (negative volume) and folded sheets (none) would satisfy the edge rule as well but
//! are left open: that costs time, never a wrong bit.

use super::intern::{Intern, comparable};
use glam::{DVec3, Vec3};
use shadowgraph_core::scene::flag;

/// Smallest volume of a closed part, over its area to the power 3/2: far above f64 rounding, far below a hair's
/// (radius over length of a millionth gives 2e-4).
const SMALLEST_VOLUME: f64 = 1e-10;

/// Parts of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// [`flag::CLOSED`] or zero, a word a triangle.
    pub closed_flag: Vec<u32>,
    /// Connected parts.
    pub parts_count: usize,
    /// Closed ones among them.
    pub closed_count: usize,
}

/// Welds within each shape first, so that touching solids stay apart; what is open then is welded across shapes, so that
/// a solid which was split (by material, say) is whole again.
pub fn find_parts(positions: &[[[f32; 3]; 3]], shapes: &[u32]) -> Parts {
    let all: Vec<u32> = (0..positions.len() as u32).collect();
    let within = weld(positions, &all, |triangle| shapes[triangle as usize]);
    let mut parts = Parts { closed_flag: vec![0; positions.len()], ..Parts::default() };
    let mut left = Vec::new();
    for (&triangle, &part) in all.iter().zip(&within.part_of) {
        match within.closed[part as usize] {
            true => parts.closed_flag[triangle as usize] = flag::CLOSED,
            false => left.push(triangle),
        }
    }
    let across = weld(positions, &left, |_| 0);
    for (&triangle, &part) in left.iter().zip(&across.part_of) {
        if across.closed[part as usize] {
            parts.closed_flag[triangle as usize] = flag::CLOSED;
        }
    }
    let closed = |welded: &Welded| welded.closed.iter().filter(|closed| **closed).count();
    parts.closed_count = closed(&within) + closed(&across);
    parts.parts_count = closed(&within) + across.closed.len();
    parts
}

/// Triangles by part.
pub(super) struct Welded {
    /// Part of each given triangle.
    pub part_of: Vec<u32>,
    /// Whether it is closed, by part.
    pub closed: Vec<bool>,
}

/// Parts of some triangles, which meet where positions and groups are equal.
pub(super) fn weld(positions: &[[[f32; 3]; 3]], triangles: &[u32], group: impl Fn(u32) -> u32) -> Welded {
    let mut vertices = Intern::<4>::with_capacity(triangles.len());
    let corner_vertex: Vec<[u32; 3]> = triangles
        .iter()
        .map(|&triangle| {
            positions[triangle as usize].map(|corner| {
                let [x, y, z] = comparable(corner);
                vertices.number([group(triangle), x, y, z])
            })
        })
        .collect();

    // Faces along each edge, in its two directions. A triangle with two equal corners is no face: its two other edges are
    // one edge in both directions, so that its neighbours meet when it is left out.
    let mut edges = Intern::<2>::with_capacity(triangles.len() * 3 / 2);
    let mut faces_along: Vec<[u8; 2]> = Vec::new();
    let is_face = |[a, b, c]: [u32; 3]| a != b && b != c && c != a;
    for &corners in corner_vertex.iter().filter(|corners| is_face(**corners)) {
        for [from, to] in directed_edges(corners) {
            let edge = edges.number([from.min(to), from.max(to)]) as usize;
            faces_along.resize(faces_along.len().max(edge + 1), [0; 2]);
            let count = &mut faces_along[edge][usize::from(from > to)];
            *count = count.saturating_add(1);
        }
    }

    let mut forest = Forest::new(vertices.keys().len());
    for &[a, b, c] in &corner_vertex {
        forest.join(a, b);
        forest.join(b, c);
    }
    let (part_of_vertex, parts_count) = forest.parts();
    let part_of: Vec<u32> = corner_vertex.iter().map(|corners| part_of_vertex[corners[0] as usize]).collect();

    let mut closed = vec![true; parts_count];
    for (&[vertex, _], faces) in edges.keys().iter().zip(&faces_along) {
        closed[part_of_vertex[vertex as usize] as usize] &= *faces == [1, 1];
    }
    let mut volume = vec![0.0; parts_count];
    let mut area = vec![0.0; parts_count];
    let mut origin = vec![None; parts_count];
    for (&triangle, &part) in triangles.iter().zip(&part_of) {
        let [a, b, c] = positions[triangle as usize].map(|corner| Vec3::from(corner).as_dvec3());
        // Measured from a corner of the part itself, so that its distance from the world's origin costs no digits.
        let origin: DVec3 = *origin[part as usize].get_or_insert(a);
        volume[part as usize] += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
        area[part as usize] += (b - a).cross(c - a).length() / 2.0;
    }
    for part in 0..parts_count {
        closed[part] &= volume[part] > SMALLEST_VOLUME * area[part].powf(1.5);
    }
    Welded { part_of, closed }
}

fn directed_edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Disjoint sets of vertices.
struct Forest(Vec<u32>);

impl Forest {
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    fn root(&mut self, mut vertex: u32) -> u32 {
        while self.0[vertex as usize] != vertex {
            let grandparent = self.0[self.0[vertex as usize] as usize];
            self.0[vertex as usize] = grandparent;
            vertex = grandparent;
        }
        vertex
    }

    /// The smaller root stays, so that parts are numbered alike on every run.
    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// Part of every vertex, numbered from zero in order of first appearance, and their count.
    fn parts(mut self) -> (Vec<u32>, usize) {
        let mut number_of_root = vec![u32::MAX; self.0.len()];
        let mut count = 0;
        let part_of = (0..self.0.len() as u32).map(|vertex| {
            let root = self.root(vertex) as usize;
            if number_of_root[root] == u32::MAX {
                number_of_root[root] = count;
                count += 1;
            }
            number_of_root[root]
        });
        let part_of = part_of.collect();
        (part_of, count as usize)
    }
}
