//! Casters in parallel; each walks the rows of its footprint, and each row is one run of listed view-samples.

use crate::shared::footprint::{Footprint, Grid};
use crate::shared::hard::{Scene, mask};
use crate::shared::light_frame;
use crate::shared::pair_counts::PairCounts;
use crate::shared::predicate::Corners;
use crate::shared::pyramid::{Planes, Reach};
use crate::shared::receivers::{FaceRange, Receivers, Settle};
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Casters that one task takes: enough to hide its cost, few enough to share out big ones.
const CASTERS_A_TASK: usize = 256;

/// Everything a task reads.
struct Walk<'a> {
    scene: Scene<'a>,
    caster_state: &'a [u32],
    receivers: Receivers<'a>,
    grids: Vec<Grid>,
    extents: Vec<[f64; 2]>,
    side: usize,
    offsets: &'a [u32],
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    run_at(cx, Level::new())
}

/// With a given instruction set.
pub(super) fn run_at(cx: &mut CpuCx, level: Level) -> Result<(), Problem> {
    let faces = light_frame::faces(cx.input("light_frame").as_f32());
    let scene = Scene::new(cx, &faces)?;
    let side = cx.input("list_length").dim(2);
    let offsets = cx.input("list_offset").as_u32();
    let receivers = Receivers::gather(&scene, &faces, side * side, offsets, cx.input("list_entries").as_u32());
    let grid = |(face, range): (_, &FaceRange)| Grid::new(face, side, Some(range.reach));
    let grids = faces.iter().zip(&receivers.faces).map(grid).collect();
    let extents = (0..faces.len()).map(|face| receivers.extent(face)).collect();
    let caster_state = cx.input("caster_state").as_u32();
    let walk = Walk { scene, caster_state, receivers, grids, extents, side, offsets };
    let counts = walk.all(level, cx.progress());
    let wild_blocked = scene.blocked_wild(&walk.receivers, caster_state);
    let mask = mask(&walk.receivers, cx.input("sample_state").as_u32(), &wild_blocked);
    counts.count(cx);
    cx.put("mask", mask);
    Ok(())
}

impl Walk<'_> {
    /// Every caster on every face.
    fn all(&self, level: Level, progress: &(dyn Fn(u64, u64) + Sync)) -> PairCounts {
        let tasks = self.scene.triangles.par_chunks(CASTERS_A_TASK).enumerate();
        let (done, total) = (AtomicU64::new(0), tasks.len() as u64);
        let step = (total / 100).max(1);
        tasks
            .map(|(task, triangles)| {
                let counts = dispatch!(level, simd => self.task(simd, task * CASTERS_A_TASK, triangles));
                let done = done.fetch_add(1, Relaxed) + 1;
                if done % step == 0 {
                    progress(done, total);
                }
                counts
            })
            .sum()
    }

    #[inline(always)]
    fn task<S: Simd>(&self, simd: S, first: usize, triangles: &[Corners]) -> PairCounts {
        let mut counts = PairCounts::default();
        for (face, range) in self.receivers.faces.iter().enumerate() {
            if range.places[0] == range.places[1] {
                continue;
            }
            for (index, corners) in triangles.iter().enumerate() {
                if self.caster_state[first + index] != 0 {
                    counts += self.caster(simd, face, first + index, corners);
                }
            }
        }
        counts
    }

    #[inline(always)]
    fn caster<S: Simd>(&self, simd: S, face: usize, caster: usize, corners: &Corners) -> PairCounts {
        let grid = &self.grids[face];
        let range = &self.receivers.faces[face];
        let turned = range.space.corners(corners);
        if grid.is_beside(&turned) {
            return PairCounts::default();
        }
        let (cone, footprint, planes) = match range.space.reach_of(corners, turned) {
            Reach::Nothing => return PairCounts::default(),
            Reach::Anything => (None, Footprint::everything(grid), Planes::ANYTHING),
            Reach::Cone(cone) => {
                let Some(footprint) = Footprint::new(&cone, grid) else {
                    return PairCounts::default();
                };
                (Some(cone), footprint, Planes::new(&cone, self.extents[face]))
            }
        };
        let mut settle = Settle::new(&self.scene, range, caster as u32, Some(cone));
        let cells = face * self.side * self.side;
        for row in footprint.rows[0]..=footprint.rows[1] {
            if let Some([first, last]) = footprint.span(grid, row) {
                let start = cells + row * self.side;
                self.run_of_cells(simd, [start + first, start + last], &planes, &footprint, &mut settle);
            }
        }
        settle.counts
    }

    /// Neighbouring cells, first and last.
    #[inline(always)]
    fn run_of_cells<S: Simd>(
        &self,
        simd: S,
        cells: [usize; 2],
        planes: &Planes,
        footprint: &Footprint,
        settle: &mut Settle,
    ) {
        let receivers = &self.receivers;
        let shift = settle.shift();
        let place = |cell: usize| self.offsets[cell] as usize + shift;
        let [mut from, to] = [place(cells[0]), place(cells[1] + 1)];
        if from < to && !receivers.trees.is_empty() {
            for (cell, root) in receivers.trees.between(cells[0], cells[1]) {
                receivers.test_run(simd, [from, place(*cell as usize)], planes, settle);
                receivers.trees.test(simd, receivers, *root, planes, &footprint.bounds, settle);
                from = place(*cell as usize + 1);
            }
        }
        receivers.test_run(simd, [from, to], planes, settle);
    }
}
