//! Rows of pixels in parallel, each ray alone.

use crate::shared::bvh::{Bvh, Walk};
use crate::shared::camera::Camera;
use crate::view_samples::surface::{Corners, Edges, Rows, Seen, camera_of};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::NO_TRIANGLE;
use std::sync::atomic::{AtomicU64, Ordering};

/// View-samples of the picture.
pub fn cast(corners: &[Corners], camera: &Camera, image: [usize; 2], progress: &(dyn Fn(u64, u64) + Sync)) -> Seen {
    let [width, height] = image;
    let mut seen = Seen::background(width * height);
    let tree = Bvh::build(corners, |_| true);
    let project = |corners: &Corners| Edges::new(corners.map(|corner| camera.project(Vec3::from(corner))));
    let edges: Vec<Option<Edges>> = corners.par_iter().map(project).collect();
    let done = AtomicU64::new(0);
    let rows = seen
        .positions
        .par_chunks_mut(width.max(1))
        .zip(seen.normals.par_chunks_mut(width.max(1)))
        .zip(seen.triangles.par_chunks_mut(width.max(1)))
        .enumerate();
    rows.for_each_init(Walk::default, |walk, (row, ((positions, normals), triangles))| {
        for (column, triangle) in triangles.iter_mut().enumerate() {
            let (column, row) = (column as f64 + 0.5, row as f64 + 0.5);
            let ray = camera.ray(column, row);
            let mut best = (0.0, NO_TRIANGLE);
            tree.along_ray(walk, camera.eye.to_array(), ray.to_array(), |id| {
                if let Some(near) = edges[id as usize].and_then(|edges| edges.nearness(column, row)) {
                    // Of equally near ones the lowest, in whatever order the tree has them.
                    if near > best.0 || (near == best.0 && id < best.1) {
                        best = (near, id);
                    }
                }
                // The ray is one deep a unit, so t is the depth; a little more for its rounding.
                (1.0 + 1e-9) / best.0
            });
            *triangle = best.1;
        }
        Rows { first: row, width, positions, normals, triangles }.resolve(corners, camera);
        // Only a count to show: no other memory is ordered by it.
        progress(done.fetch_add(1, Ordering::Relaxed) + 1, height as u64);
    });
    seen
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let camera = camera_of(cx)?;
    let corners: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    cast(corners, &camera, cx.image(), cx.progress()).put(cx);
    Ok(())
}
