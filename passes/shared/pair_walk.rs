//! The (cell, caster) pairs of a face's regions, on the CPU: casters in parallel; each walks its region row by row and claims a slot
//! in every cell that matters.

use crate::shared::footprint::{Grid, reach_among};
use crate::shared::light_frame::{self, Face};
use crate::shared::predicate::Corners;
use crate::shared::pyramid::LightSpace;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::{Kind, Problem};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// Pairs that are kept at most: with a working copy they take 6 GiB.
pub const MOST_PAIRS: u64 = 1 << 28;
/// Casters that one task takes.
const CASTERS_A_TASK: usize = 256;

/// The cells of a face in which a caster can matter.
pub trait Region {
    /// First and last row.
    fn rows(&self) -> [usize; 2];
    /// First and last column touched in `row`, which is one of [`Region::rows`].
    fn span(&self, grid: &Grid, row: usize) -> Option<[usize; 2]>;
    /// Whether no view-sample of the cell at column and row `at`, whose largest depth is `list_far`, can be blocked.
    fn is_behind(&self, grid: &Grid, at: [usize; 2], list_far: f32) -> bool;
}

/// One face, as regions are made for it.
pub struct Side {
    /// The face.
    pub face: Face,
    /// World to its light space.
    pub space: LightSpace,
    /// Its texels.
    pub grid: Grid,
}

/// Everything a task reads, and what all of them count.
struct Walk<'a> {
    triangles: &'a [Corners],
    caster_state: &'a [u32],
    cells: Cells<'a>,
    caster_length: Vec<AtomicU32>,
    pairs: AtomicU64,
    behind: AtomicU64,
    most_pairs: u64,
}

/// Cells that have view-samples: most have none where six faces share them.
struct Full {
    cells: Vec<u32>,
    /// How many of them lie before each cell.
    before: Vec<u32>,
}

impl Full {
    fn new(list_length: &[u32]) -> Self {
        let cells: Vec<u32> = (0..list_length.len() as u32).filter(|cell| list_length[*cell as usize] > 0).collect();
        let mut before = Vec::with_capacity(list_length.len() + 1);
        let mut count = 0;
        for length in list_length {
            before.push(count);
            count += u32::from(*length > 0);
        }
        before.push(count);
        Self { cells, before }
    }

    /// Those from cell `first` to cell `last`.
    fn between(&self, first: usize, last: usize) -> &[u32] {
        &self.cells[self.before[first] as usize..self.before[last + 1] as usize]
    }
}

/// Cells of the light's image, as regions are walked.
struct Cells<'a> {
    full: Full,
    list_far: &'a [f32],
}

/// One pair: cell, slot, caster.
type Pair = [u32; 3];

/// The faces of the frame that `cx` is given, as a grid of `list_length` divides them.
pub fn sides(cx: &CpuCx) -> Vec<Side> {
    let side = cx.input("list_length").dim(2);
    let faces = light_frame::faces(cx.input("light_frame").as_f32());
    let of = |index: usize| {
        let face = faces[index];
        Side { face, space: LightSpace::new(&face), grid: Grid::new(&face, side, reach_among(&faces, index)) }
    };
    (0..faces.len()).map(of).collect()
}

/// Puts the pairs of `region`, which is asked for the region of a caster on one of `sides`, given by its index; counts `pairs`
/// and `pairs_behind`.
///
/// # Errors
/// More than `most_pairs` pairs.
pub fn put_pairs<R: Region>(
    cx: &mut CpuCx,
    most_pairs: u64,
    sides: &[Side],
    region: impl Fn(usize, &Corners) -> Option<R> + Sync,
) -> Result<(), Problem> {
    let shape = cx.input("list_length").shape();
    let list_length = cx.input("list_length").as_u32();
    let walk = Walk {
        triangles: bytemuck::cast_slice(cx.input("triangles").as_f32()),
        caster_state: cx.input("caster_state").as_u32(),
        cells: Cells { full: Full::new(list_length), list_far: cx.input("list_far").as_f32() },
        caster_length: list_length.iter().map(|_| AtomicU32::new(0)).collect(),
        pairs: AtomicU64::new(0),
        behind: AtomicU64::new(0),
        most_pairs,
    };
    let tasks = walk.triangles.par_chunks(CASTERS_A_TASK).enumerate();
    let tasks: Vec<Vec<Pair>> = tasks.map(|(task, _)| walk.task(task * CASTERS_A_TASK, sides, &region)).collect();
    let (pairs, behind) = (walk.pairs.into_inner(), walk.behind.into_inner());
    if pairs > most_pairs {
        return Err(Problem::new(Kind::Overflow, "more (cell, caster) pairs than memory is kept for")
            .port("pair_cell")
            .expected(format!("at most {most_pairs} pairs"))
            .found(format!("{pairs} pairs"))
            .remedy("give list_build fewer texels, or use the visibility pass `fused`, which stores no pairs"));
    }
    cx.count("pairs", pairs);
    cx.count("pairs_behind", behind);
    for (port, column) in [("pair_cell", 0), ("pair_slot", 1), ("pair_caster", 2)] {
        let mut words = Vec::with_capacity(pairs as usize);
        words.par_extend(tasks.par_iter().flat_map_iter(|pairs| pairs.iter().map(|pair| pair[column])));
        cx.put(port, Array::u32([words.len()], words));
    }
    let lengths = walk.caster_length.into_iter().map(AtomicU32::into_inner).collect();
    cx.put("caster_length", Array::u32(shape, lengths));
    Ok(())
}

/// Cells `[F S S]` with view-samples that the region of some of `triangles` meets: 1; others: 0. `list_length` and `list_far` as
/// their ports, `region` as of [`put_pairs`].
pub fn mark_cells<R: Region>(
    triangles: &[Corners],
    sides: &[Side],
    list_length: &[u32],
    list_far: &[f32],
    region: impl Fn(usize, &Corners) -> Option<R> + Sync,
) -> Vec<u32> {
    let cells = Cells { full: Full::new(list_length), list_far };
    let marks: Vec<AtomicU32> = list_length.iter().map(|_| AtomicU32::new(0)).collect();
    triangles.par_iter().with_min_len(CASTERS_A_TASK).for_each(|corners| {
        for (face, side) in sides.iter().enumerate().filter(|(_, side)| side.face.valid) {
            if let Some(region) = region(face, corners) {
                cells.walk(face, &side.grid, &region, &mut 0, |cell| marks[cell].store(1, Relaxed));
            }
        }
    });
    marks.into_iter().map(AtomicU32::into_inner).collect()
}

impl Walk<'_> {
    /// The pairs of the casters from `first` on; once all together are too many they are only counted.
    fn task<R: Region>(
        &self,
        first: usize,
        sides: &[Side],
        region: &impl Fn(usize, &Corners) -> Option<R>,
    ) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let (mut count, mut behind, mut full) = (0, 0, false);
        let casters = first..(first + CASTERS_A_TASK).min(self.triangles.len());
        for caster in casters.filter(|caster| self.caster_state[*caster] != 0) {
            for (face, side) in sides.iter().enumerate().filter(|(_, side)| side.face.valid) {
                let Some(region) = region(face, &self.triangles[caster]) else { continue };
                self.cells.walk(face, &side.grid, &region, &mut behind, |cell| {
                    count += 1;
                    // Looking once in a while bounds what is stored beyond the cap.
                    full = full || (count % 4096 == 1 && self.pairs.load(Relaxed) + count > self.most_pairs);
                    if !full {
                        let slot = self.caster_length[cell].fetch_add(1, Relaxed);
                        pairs.push([cell as u32, slot, caster as u32]);
                    }
                });
            }
        }
        self.pairs.fetch_add(count, Relaxed);
        self.behind.fetch_add(behind, Relaxed);
        pairs
    }
}

impl Cells<'_> {
    /// Calls `pair` with each cell of `face` that `region` is to be listed in.
    fn walk<R: Region>(&self, face: usize, grid: &Grid, region: &R, behind: &mut u64, mut pair: impl FnMut(usize)) {
        let rows = region.rows();
        for row in rows[0]..=rows[1] {
            let Some([first, last]) = region.span(grid, row) else {
                continue;
            };
            let start = (face * grid.side + row) * grid.side;
            for cell in self.full.between(start + first, start + last) {
                let cell = *cell as usize;
                if region.is_behind(grid, [cell - start, row], self.list_far[cell]) {
                    *behind += 1;
                } else {
                    pair(cell);
                }
            }
        }
    }
}
