//! Smooth vertices: corners with equal position and equal shading normal in one shape, and the triangles around each.

use super::intern::{Intern, comparable};

/// Fields of [`shadowgraph_core::scene::Scene`] of the same names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Smooth {
    /// Smooth vertex at each corner.
    pub corner_vertex: Vec<[u32; 3]>,
    /// Start of each vertex's triangles in `faces`, and the end.
    pub face_offset: Vec<u32>,
    /// Triangles around the vertices, ascending, each once a vertex.
    pub faces: Vec<u32>,
}

/// Smooth vertices of a scene, numbered in order of first appearance.
pub fn smooth_vertices(positions: &[[[f32; 3]; 3]], normals: &[[[f32; 3]; 3]], shapes: &[u32]) -> Smooth {
    let mut vertices = Intern::<7>::with_capacity(positions.len());
    let corner_vertex: Vec<[u32; 3]> = (0..positions.len())
        .map(|triangle| {
            [0, 1, 2].map(|corner| {
                let [x, y, z] = comparable(positions[triangle][corner]);
                let [nx, ny, nz] = comparable(normals[triangle][corner]);
                vertices.number([shapes[triangle], x, y, z, nx, ny, nz])
            })
        })
        .collect();

    let mut face_offset = vec![0u32; vertices.keys().len() + 1];
    for corners in &corner_vertex {
        for vertex in distinct(corners) {
            face_offset[vertex as usize + 1] += 1;
        }
    }
    for vertex in 1..face_offset.len() {
        face_offset[vertex] += face_offset[vertex - 1];
    }
    let mut next = face_offset.clone();
    let mut faces = vec![0; face_offset.last().map_or(0, |end| *end as usize)];
    for (triangle, corners) in corner_vertex.iter().enumerate() {
        for vertex in distinct(corners) {
            faces[next[vertex as usize] as usize] = triangle as u32;
            next[vertex as usize] += 1;
        }
    }
    Smooth { corner_vertex, face_offset, faces }
}

/// The corners without repeats: a triangle with two equal corners stands once around their vertex.
fn distinct(&[a, b, c]: &[u32; 3]) -> impl Iterator<Item = u32> {
    [Some(a), (b != a).then_some(b), (c != a && c != b).then_some(c)].into_iter().flatten()
}
