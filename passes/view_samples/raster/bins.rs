//! Which rows of the picture a triangle may cover.

use crate::shared::camera::Camera;
use crate::view_samples::surface::{Corners, Edges};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Rows of a band, which one task owns.
pub const BAND: usize = 16;
/// A triangle over more bands is kept once, for all of them.
const FEW_BANDS: usize = 4;
/// Triangles that one task bins.
const CHUNK: usize = 4096;
/// Widening of bounds, pixels; above the rounding of a projection.
const PAD: f64 = 1e-6;

/// Columns and rows that a triangle may cover, first and last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Index of the triangle.
    pub triangle: u32,
    /// First and last column.
    pub columns: [u32; 2],
    /// First and last row.
    pub rows: [u32; 2],
}

/// The spans of a chunk of triangles, ascending in each list.
pub struct Bins {
    bands: Vec<Vec<Span>>,
    wide: Vec<Span>,
}

/// Bins of all triangles, chunk by chunk.
pub fn bin(corners: &[Corners], camera: &Camera, image: [usize; 2]) -> Vec<Bins> {
    let band_count = image[1].div_ceil(BAND);
    let chunks = corners.par_chunks(CHUNK).enumerate();
    let bins = chunks.map(|(chunk, corners)| {
        let mut bins = Bins { bands: vec![Vec::new(); band_count], wide: Vec::new() };
        for (index, corners) in corners.iter().enumerate() {
            let Some((columns, rows)) = bounds(&projected(corners, camera), image) else { continue };
            let span = Span { triangle: (chunk * CHUNK + index) as u32, columns, rows };
            let [first, last] = rows.map(|row| row as usize / BAND);
            if last - first < FEW_BANDS {
                bins.bands[first..=last].iter_mut().for_each(|band| band.push(span));
            } else {
                bins.wide.push(span);
            }
        }
        bins
    });
    bins.collect()
}

/// Homogeneous picture coordinates of the corners.
pub fn projected(corners: &Corners, camera: &Camera) -> [DVec3; 3] {
    corners.map(|corner| camera.project(Vec3::from(corner)))
}

impl Bins {
    /// Calls `visit` with the edge functions and the span of each triangle that may cover rows of `band`.
    pub fn for_each(&self, band: usize, corners: &[Corners], camera: &Camera, mut visit: impl FnMut(&Edges, &Span)) {
        let [first, last] = [band * BAND, band * BAND + BAND - 1];
        let wide = self.wide.iter().filter(|span| span.rows[0] as usize <= last && span.rows[1] as usize >= first);
        for span in self.bands[band].iter().chain(wide) {
            if let Some(edges) = Edges::new(projected(&corners[span.triangle as usize], camera)) {
                visit(&edges, span);
            }
        }
    }
}

/// First and last columns, and first and last rows, whose centres a triangle may cover; none where it covers none.
fn bounds(corners: &[DVec3; 3], image: [usize; 2]) -> Option<([u32; 2], [u32; 2])> {
    let size = image.map(|side| side as f64);
    if corners.iter().all(|corner| corner.z > 0.0) {
        return box_of(corners, size);
    }
    if !corners.iter().any(|corner| corner.z > 0.0) {
        return None;
    }
    let polygon = clipped(corners, size);
    // Next to the eye a quotient says nothing.
    let deepest = polygon.iter().map(|corner| corner.z).fold(0.0, f64::max);
    if polygon.iter().any(|corner| corner.z <= 1e-9 * deepest) {
        let whole = |side: usize| [0, image[side] as u32 - 1];
        return Some((whole(0), whole(1)));
    }
    box_of(&polygon, size)
}

/// [`bounds`] of a polygon in front of the eye.
fn box_of(polygon: &[DVec3], size: [f64; 2]) -> Option<([u32; 2], [u32; 2])> {
    let range = |axis: usize| {
        let ratios = polygon.iter().map(|corner| corner[axis] / corner.z);
        let (low, high) = ratios.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let first = (low - 0.5 - PAD).ceil().max(0.0);
        let last = (high - 0.5 + PAD).floor().min(size[axis] - 1.0);
        (first <= last).then_some([first as u32, last as u32])
    };
    Some((range(0)?, range(1)?))
}

/// The part of a triangle within the four side planes of the picture: a cone that ends at the eye, so all of it lies in front.
fn clipped(corners: &[DVec3; 3], size: [f64; 2]) -> Vec<DVec3> {
    let sides: [&dyn Fn(DVec3) -> f64; 4] = [&|p| p.x, &|p| size[0] * p.z - p.x, &|p| p.y, &|p| size[1] * p.z - p.y];
    let mut polygon = corners.to_vec();
    for side in sides {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (index, &to) in polygon.iter().enumerate() {
            let from = polygon[(index + polygon.len() - 1) % polygon.len()];
            let (a, b) = (side(from), side(to));
            if (a < 0.0) != (b < 0.0) {
                kept.push(from + (to - from) * (a / (a - b)));
            }
            if b >= 0.0 {
                kept.push(to);
            }
        }
        polygon = kept;
    }
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_between_pixel_centres_covers_none() {
        let corner = |x: f64, y: f64| DVec3::new(2.0 * x, 2.0 * y, 2.0);
        assert_eq!(bounds(&[corner(1.6, 1.6), corner(2.4, 1.6), corner(2.0, 2.4)], [8, 8]), None);
        assert_eq!(bounds(&[corner(1.4, 1.6), corner(2.4, 1.6), corner(2.0, 2.6)], [8, 8]), Some(([1, 1], [2, 2])));
        assert_eq!(bounds(&[corner(-9.0, -9.0), corner(-2.0, 3.0), corner(-1.0, 9.0)], [8, 8]), None);
    }

    #[test]
    fn a_triangle_through_the_eye_plane_keeps_the_rows_it_reaches() {
        // A floor from behind the eye to depth 4, where it stands at row 6; nearer it falls out at the bottom.
        let floor = [DVec3::new(16.0, 24.0, 4.0), DVec3::new(20.0, 24.0, 4.0), DVec3::new(0.0, 20.0, -4.0)];
        let (columns, rows) = bounds(&floor, [8, 8]).unwrap();
        assert_eq!(rows, [6, 7]);
        assert!(columns[0] <= 4 && columns[1] >= 4);
        let behind = floor.map(|corner| DVec3::new(corner.x, corner.y, -1.0));
        assert_eq!(bounds(&behind, [8, 8]), None);
        let beside = floor.map(|corner| DVec3::new(100.0, corner.y, corner.z));
        assert_eq!(bounds(&beside, [8, 8]), None);
    }
}
