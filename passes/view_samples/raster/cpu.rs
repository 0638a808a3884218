//! Bands of rows in parallel, each with a z-buffer of its own.

use super::bins::{BAND, Bins, Span, bin};
use crate::shared::camera::Camera;
use crate::view_samples::surface::{Corners, Edges, Rows, Seen, camera_of};
use rayon::prelude::*;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::NO_TRIANGLE;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Rows of a triangle longer than this are first cut to what its edge functions leave of them.
const LONG_ROW: u32 = 16;

/// View-samples of the picture.
pub fn raster(corners: &[Corners], camera: &Camera, image: [usize; 2], progress: &(dyn Fn(u64, u64) + Sync)) -> Seen {
    let width = image[0];
    let mut seen = Seen::background(width * image[1]);
    let bins = bin(corners, camera, image);
    let done = AtomicU64::new(0);
    let band_count = image[1].div_ceil(BAND) as u64;
    let size = (width * BAND).max(1);
    let bands = seen
        .positions
        .par_chunks_mut(size)
        .zip(seen.normals.par_chunks_mut(size))
        .zip(seen.triangles.par_chunks_mut(size))
        .enumerate();
    bands.for_each(|(band, ((positions, normals), triangles))| {
        let mut rows = Rows { first: band * BAND, width, positions, normals, triangles };
        nearest(&mut rows, band, &bins, corners, camera);
        rows.resolve(corners, camera);
        // Only a count to show: no other memory is ordered by it.
        progress(done.fetch_add(1, Ordering::Relaxed) + 1, band_count);
    });
    seen
}

/// The nearest triangle at each pixel of a band.
fn nearest(rows: &mut Rows, band: usize, bins: &[Bins], corners: &[Corners], camera: &Camera) {
    let row_count = rows.triangles.len() / rows.width;
    // 1 / depth: above zero wherever something is seen.
    let mut nearness = vec![0.0; rows.triangles.len()];
    for bins in bins {
        bins.for_each(band, corners, camera, |edges, span| {
            let first = (span.rows[0] as usize).max(rows.first);
            let last = (span.rows[1] as usize).min(rows.first + row_count - 1);
            for row in first..=last {
                let start = (row - rows.first) * rows.width;
                let centre = row as f64 + 0.5;
                for column in columns(edges, span, centre) {
                    let pixel = start + column as usize;
                    let Some(near) = edges.nearness(f64::from(column) + 0.5, centre) else { continue };
                    // Of equally near ones the lowest, whichever came first.
                    let nearer = near > nearness[pixel];
                    if nearer || (near == nearness[pixel] && span.triangle < rows.triangles[pixel]) {
                        nearness[pixel] = near;
                        rows.triangles[pixel] = span.triangle;
                    }
                }
            }
        });
    }
    debug_assert!(nearness.iter().zip(rows.triangles.iter()).all(|(near, id)| (*near > 0.0) == (*id != NO_TRIANGLE)));
}

/// Columns of a row that may lie within all three edges; a column too many on either side covers the rounding.
fn columns(edges: &Edges, span: &Span, row: f64) -> Range<u32> {
    let [first, last] = span.columns;
    if last - first < LONG_ROW {
        return first..last + 1;
    }
    let (mut low, mut high) = (f64::from(first), f64::from(last));
    for edge in edges.functions {
        let crossing = -(edge.y * row + edge.z) / edge.x - 0.5;
        // Not a number, or infinite, where the edge runs along the row: then it cuts nothing.
        if edge.x > 0.0 && crossing.is_finite() {
            low = low.max(crossing.floor());
        } else if edge.x < 0.0 && crossing.is_finite() {
            high = high.min(crossing.ceil());
        }
    }
    // Empty where the two have crossed.
    low as u32..high as u32 + 1
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let camera = camera_of(cx)?;
    let corners: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    raster(corners, &camera, cx.image(), cx.progress()).put(cx);
    Ok(())
}
