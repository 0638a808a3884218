//! Cells in parallel; in each, its casters one after the other against its view-samples, sixteen at a time.

use crate::shared::hard::{Scene, mask};
use crate::shared::light_frame;
use crate::shared::pair_counts::PairCounts;
use crate::shared::pyramid::Planes;
use crate::shared::receiver_tree::EVERYWHERE;
use crate::shared::receivers::{Receivers, Settle};
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// Cells that one task takes.
const CELLS_A_TASK: usize = 64;

/// Everything a task reads.
struct Join<'a> {
    scene: Scene<'a>,
    receivers: Receivers<'a>,
    offsets: &'a [u32],
    caster_offsets: &'a [u32],
    caster_entries: &'a [u32],
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let faces = light_frame::faces(cx.input("light_frame").as_f32());
    let scene = Scene::new(cx, &faces)?;
    let side = cx.input("list_length").dim(2);
    let offsets = cx.input("list_offset").as_u32();
    let receivers = Receivers::gather(&scene, &faces, side * side, offsets, cx.input("list_entries").as_u32());
    let caster_offsets = cx.input("caster_offset").as_u32();
    let caster_entries = cx.input("caster_entries").as_u32();
    let join = Join { scene, receivers, offsets, caster_offsets, caster_entries };
    let level = Level::new();
    let counts: PairCounts = (0..faces.len()).map(|face| join.face(level, face, side * side)).sum();
    let wild_blocked = scene.blocked_wild(&join.receivers, cx.input("caster_state").as_u32());
    let mask = mask(&join.receivers, cx.input("sample_state").as_u32(), &wild_blocked);
    counts.count(cx);
    cx.put("mask", mask);
    Ok(())
}

impl Join<'_> {
    /// All cells of `face`.
    fn face(&self, level: Level, face: usize, cell_count: usize) -> PairCounts {
        let range = &self.receivers.faces[face];
        if range.places[0] == range.places[1] {
            return PairCounts::default();
        }
        let extent = self.receivers.extent(face);
        let planes = |corners| Planes::of(&range.space.reach(corners), extent);
        let planes: Vec<Planes> = self.scene.triangles.par_iter().with_min_len(1 << 10).map(planes).collect();
        let cells: Vec<usize> = (face * cell_count..(face + 1) * cell_count).collect();
        cells
            .par_chunks(CELLS_A_TASK)
            .map(|cells| {
                dispatch!(level, simd => cells.iter().map(|cell| self.cell(simd, face, *cell, &planes)).sum::<PairCounts>())
            })
            .sum()
    }

    #[inline(always)]
    fn cell<S: Simd>(&self, simd: S, face: usize, cell: usize, planes: &[Planes]) -> PairCounts {
        let range = &self.receivers.faces[face];
        let [from, to] = [cell, cell + 1].map(|at| self.offsets[at] as usize + range.shift);
        if from == to {
            return PairCounts::default();
        }
        let trees = &self.receivers.trees;
        let tree = trees.between(cell, cell).first();
        let mut counts = PairCounts::default();
        let [start, end] = [cell, cell + 1].map(|at| self.caster_offsets[at] as usize);
        for caster in &self.caster_entries[start..end] {
            let mut settle = Settle::new(&self.scene, range, *caster, None);
            let planes = &planes[*caster as usize];
            let open = if let Some((_, root)) = tree {
                trees.test(simd, &self.receivers, *root, planes, &EVERYWHERE, &mut settle);
                !trees.is_full(*root)
            } else {
                self.receivers.test_run(simd, [from, to], planes, &mut settle).open
            };
            counts += settle.counts;
            if !open {
                break;
            }
        }
        counts
    }
}
