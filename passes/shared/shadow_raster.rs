//! The casters' depth in a face's map, rasterised on the CPU: the twin of a depth-only draw.
//!
//! A texel is covered when the ray from the light through its centre meets the closed triangle (a device leaves one of two
//! triangles out at a shared edge: the nearer wins either way). Rays and triangles meet in homogeneous form: for corners A, B, C
//! from the light, direction r = (u, v, 1) hits when r . (A x B), r . (B x C), r . (C x A) all have the sign of det(A, B, C),
//! and depth 1 / w is the linear function r . N / (N . A) of u and v, N the triangle's normal. So nothing is clipped: corners
//! behind the light need no care, and near and far plane are two more linear conditions on the columns of a row.

use crate::shared::light_frame::Face;
use crate::shared::shadow_map::NEAR_SHARE;
use glam::DVec3;
use rayon::prelude::*;

/// Rows that one thread fills at a time.
const BAND_ROWS: usize = 64;

/// What every texel of an empty map holds.
pub const CLEAR: f32 = 1.0;

/// A linear function of the column and row of a texel's centre.
#[derive(Clone, Copy)]
struct Linear {
    at_zero: f64,
    per_column: f64,
    per_row: f64,
}

/// A caster in the map: inside where all `conditions` are 0 or above.
struct Footprint {
    /// Three edges, near plane, far plane.
    conditions: [Linear; 5],
    depth: Linear,
}

/// A face as the rasteriser needs it.
struct View {
    origin: DVec3,
    axes: [DVec3; 3],
    /// u, v of the centre of texel (0, 0), and their growth with columns and rows.
    first: [f64; 2],
    pitch: [f64; 2],
    near: f64,
    far: f64,
    side: usize,
}

impl View {
    fn new(face: &Face, side: usize) -> Self {
        let pitch = face.window_size.map(|size| f64::from(size) / side as f64);
        let far = f64::from(face.far);
        Self {
            origin: face.origin.as_dvec3(),
            axes: [face.axis_x, face.axis_y, face.axis_z].map(|axis| axis.as_dvec3()),
            first: [0, 1].map(|k| f64::from(face.window_low[k]) + 0.5 * pitch[k]),
            pitch,
            near: far * f64::from(NEAR_SHARE),
            far,
            side,
        }
    }

    fn place(&self, corner: [f32; 3]) -> DVec3 {
        let offset = DVec3::from(corner.map(f64::from)) - self.origin;
        DVec3::from(self.axes.map(|axis| axis.dot(offset)))
    }

    /// Rows that a triangle may cover, first and one past the last; none when it is out of sight.
    fn rows(&self, corners: &[DVec3; 3]) -> Option<[usize; 2]> {
        let depths = corners.map(|corner| corner.z);
        if depths.iter().all(|w| *w < self.near) || depths.iter().all(|w| *w > self.far) {
            return None;
        }
        if depths.iter().any(|w| *w <= 0.0) {
            return Some([0, self.side]);
        }
        let rows = corners.map(|corner| (corner.y / corner.z - self.first[1]) / self.pitch[1]);
        let low = rows.into_iter().fold(f64::INFINITY, f64::min).ceil().max(0.0);
        let high = rows.into_iter().fold(f64::NEG_INFINITY, f64::max).floor();
        (low <= high && low < self.side as f64).then(|| [low as usize, (high as usize + 1).min(self.side)])
    }

    /// `r . n` as a linear function of columns and rows.
    fn linear(&self, n: DVec3) -> Linear {
        Linear {
            at_zero: n.x * self.first[0] + n.y * self.first[1] + n.z,
            per_column: n.x * self.pitch[0],
            per_row: n.y * self.pitch[1],
        }
    }

    /// None for a triangle seen edge-on.
    fn footprint(&self, [a, b, c]: [DVec3; 3]) -> Option<Footprint> {
        let normal = (b - a).cross(c - a);
        let height = normal.dot(a);
        if height == 0.0 || !height.is_finite() {
            return None;
        }
        let sign = height.signum();
        let edge = |from: DVec3, to: DVec3| self.linear(sign * from.cross(to - from));
        // d = far / (far - near) (1 - near / w).
        let (scale, over_w) = (self.far / (self.far - self.near), self.linear(normal / height));
        let depth = Linear {
            at_zero: scale * (1.0 - self.near * over_w.at_zero),
            per_column: -scale * self.near * over_w.per_column,
            per_row: -scale * self.near * over_w.per_row,
        };
        let beyond = Linear { at_zero: 1.0 - depth.at_zero, per_column: -depth.per_column, per_row: -depth.per_row };
        Some(Footprint { conditions: [edge(a, b), edge(b, c), edge(c, a), depth, beyond], depth })
    }
}

impl Footprint {
    /// Columns of a row that are covered, first and one past the last.
    fn columns(&self, row: usize, side: usize) -> [usize; 2] {
        let (mut low, mut high) = (0.0, side as f64 - 1.0);
        for condition in &self.conditions {
            let at_row = condition.at_zero + condition.per_row * row as f64;
            let zero = -at_row / condition.per_column;
            if condition.per_column > 0.0 {
                low = f64::max(low, zero.ceil());
            } else if condition.per_column < 0.0 {
                high = f64::min(high, zero.floor());
            } else if at_row < 0.0 {
                return [0, 0];
            }
        }
        if low <= high { [low as usize, high as usize + 1] } else { [0, 0] }
    }
}

/// Lowers `layer` (`side` x `side` texels, row by row) to the depth of every casting triangle that `accepts` (texel, depth)
/// lets through. The result does not depend on the order of triangles or threads.
pub fn draw(
    face: &Face,
    side: usize,
    triangles: &[[[f32; 3]; 3]],
    caster_state: &[u32],
    layer: &mut [f32],
    accepts: impl Fn(usize, f32) -> bool + Sync,
) {
    if !face.valid {
        return;
    }
    let view = View::new(face, side);
    let mut bands: Vec<Vec<u32>> = vec![Vec::new(); side.div_ceil(BAND_ROWS)];
    for (id, triangle) in triangles.iter().enumerate() {
        if caster_state[id] == 1
            && let Some([first, end]) = view.rows(&triangle.map(|corner| view.place(corner)))
        {
            for band in &mut bands[first / BAND_ROWS..=(end - 1) / BAND_ROWS] {
                band.push(id as u32);
            }
        }
    }
    layer.par_chunks_mut(BAND_ROWS * side).zip(&bands).enumerate().for_each(|(band, (texels, ids))| {
        let (first_row, row_count) = (band * BAND_ROWS, texels.len() / side);
        for &id in ids {
            let corners = triangles[id as usize].map(|corner| view.place(corner));
            let (Some([first, end]), Some(footprint)) = (view.rows(&corners), view.footprint(corners)) else {
                continue;
            };
            for row in first.max(first_row)..end.min(first_row + row_count) {
                let [left, right] = footprint.columns(row, side);
                let depth_at_row = footprint.depth.at_zero + footprint.depth.per_row * row as f64;
                for column in left..right {
                    let depth = (depth_at_row + footprint.depth.per_column * column as f64) as f32;
                    let place = (row - first_row) * side + column;
                    if depth < texels[place] && accepts(row * side + column, depth) {
                        texels[place] = depth;
                    }
                }
            }
        }
    });
}

#[cfg(test)]
#[path = "shadow_raster_tests.rs"]
mod tests;
