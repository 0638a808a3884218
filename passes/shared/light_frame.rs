//! The light frame: where each face of the light looks, and which texel a point falls in.
//!
//! [`WGSL`] holds the same operations in the same order, so that the two backends place a point in the same texel but for
//! the last bit of a product or quotient. Every reader of a `light_frame` port projects through this file.

use glam::Vec3;
use shadowgraph_core::shared::FACE_WORDS;

/// The projection in WGSL, joined after `shared::PRELUDE`; reads a binding named `light_frame`.
pub const WGSL: &str = include_str!("light_frame.wgsl");

/// One face. World space; axes are orthonormal to f32 rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// The light sample, or the centre of the light samples.
    pub origin: Vec3,
    /// Whether any kept view-sample falls in the face.
    pub valid: bool,
    /// Direction of growing u (columns).
    pub axis_x: Vec3,
    /// Direction of growing v (rows).
    pub axis_y: Vec3,
    /// Direction of view: depth is measured along it.
    pub axis_z: Vec3,
    /// Smallest u and v of the window.
    pub window_low: [f32; 2],
    /// Extent of the window in u and v, above zero.
    pub window_size: [f32; 2],
    /// Smallest depth of the face's view-samples, scene units, above zero.
    pub near: f32,
    /// Largest depth of the face's view-samples, scene units, above `near` or equal.
    pub far: f32,
}

/// A point as a face sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// Index of the face.
    pub face: usize,
    /// Tangent along axis x.
    pub u: f32,
    /// Tangent along axis y.
    pub v: f32,
    /// Along axis z, scene units, above zero.
    pub depth: f32,
}

impl Face {
    /// From its words; panics on fewer than [`FACE_WORDS`].
    pub fn from_words(words: &[f32]) -> Self {
        let vector = |start: usize| Vec3::from_slice(&words[start..start + 3]);
        Self {
            origin: vector(0),
            valid: words[3] > 0.5,
            axis_x: vector(4),
            axis_y: vector(8),
            axis_z: vector(12),
            window_low: [words[7], words[11]],
            window_size: [words[15], words[16]],
            near: words[17],
            far: words[18],
        }
    }

    /// Its words.
    pub fn to_words(&self) -> [f32; FACE_WORDS] {
        let mut words = [0.0; FACE_WORDS];
        for (start, vector) in [(0, self.origin), (4, self.axis_x), (8, self.axis_y), (12, self.axis_z)] {
            words[start..start + 3].copy_from_slice(&vector.to_array());
        }
        words[3] = if self.valid { 1.0 } else { 0.0 };
        [words[7], words[11]] = self.window_low;
        [words[15], words[16]] = self.window_size;
        [words[17], words[18]] = [self.near, self.far];
        words
    }

    /// Column and row of (u, v) in a window of `side` x `side` texels, clamped: border texels reach to infinity.
    #[inline]
    pub fn texel(&self, u: f32, v: f32, side: usize) -> [usize; 2] {
        let last = side as f32 - 1.0;
        let column = (u - self.window_low[0]) / self.window_size[0] * side as f32;
        let row = (v - self.window_low[1]) / self.window_size[1] * side as f32;
        // Clamped first: then the conversion is the floor, which by itself is a function call where SSE4 may be missing.
        [column, row].map(|texel| texel.max(0.0).min(last) as i32 as usize)
    }
}

/// All faces of a `light_frame` array.
pub fn faces(words: &[f32]) -> Vec<Face> {
    words.chunks_exact(FACE_WORDS).map(Face::from_words).collect()
}

/// The face whose axis `position` lies furthest along (ties: the lowest, valid or not), and its coordinates there. None
/// when it lies along none (behind a single face, at the origin) or is not finite.
#[inline]
pub fn project(faces: &[Face], position: Vec3) -> Option<Projected> {
    let mut best = 0;
    let mut depth = 0.0;
    for (index, face) in faces.iter().enumerate() {
        let along = face.axis_z.dot(position - face.origin);
        if along > depth {
            (best, depth) = (index, along);
        }
    }
    if !(depth > 0.0 && position.is_finite()) {
        return None;
    }
    let face = &faces[best];
    let offset = position - face.origin;
    Some(Projected { face: best, u: face.axis_x.dot(offset) / depth, v: face.axis_y.dot(offset) / depth, depth })
}

/// Cell of a placed point: `(face side + row) side + column`.
#[inline]
pub fn cell(faces: &[Face], point: &Projected, side: usize) -> usize {
    let [column, row] = faces[point.face].texel(point.u, point.v, side);
    (point.face * side + row) * side + column
}

/// Cell and depth of `position`; none when it cannot be placed.
#[inline]
pub fn cell_of(faces: &[Face], position: Vec3, side: usize) -> Option<(usize, f32)> {
    let point = project(faces, position)?;
    Some((cell(faces, &point, side), point.depth))
}

/// Cells and depths of `positions` as [`cell_of`] gives them, with depth 0 where it gives none. A single face, the usual
/// light, takes no branch, so that several positions are placed at once.
pub fn cells_of(faces: &[Face], positions: &[[f32; 3]], side: usize, cells: &mut [u32], depths: &mut [f32]) {
    let rows = positions.iter().zip(cells).zip(depths);
    let [face] = faces else {
        for ((position, cell), depth) in rows {
            let placed = cell_of(faces, Vec3::from(*position), side).unwrap_or((0, 0.0));
            (*cell, *depth) = (placed.0 as u32, placed.1);
        }
        return;
    };
    for ((position, cell), depth) in rows {
        let position = Vec3::from(*position);
        let offset = position - face.origin;
        let along = face.axis_z.dot(offset);
        let [column, row] = face.texel(face.axis_x.dot(offset) / along, face.axis_y.dot(offset) / along, side);
        *cell = (row * side + column) as u32;
        *depth = if along > 0.0 && position.is_finite() { along } else { 0.0 };
    }
}

/// How far rounding may have moved a projected point in u and in v, on either backend.
///
/// With s = sqrt(1 + u^2 + v^2) and e = 2^-24, the offset, three products and two sums err by at most 4 e |d| in a dot
/// product, stored axes stray from orthonormal by at most 3 e, and the depth is |d| / s: together 7 e s (1 + |u|), below
/// 8.4e-7 s^2. Large where a single face sees points almost beside the light.
#[inline]
pub fn uv_pad(u: f32, v: f32) -> f32 {
    1e-6 * (1.0 + u * u + v * v)
}

#[cfg(test)]
#[path = "light_frame_tests.rs"]
mod tests;
