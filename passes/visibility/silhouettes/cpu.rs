//! Cells in parallel.

use super::edges::Edges;
use super::worker::{Counts, Worker};
use crate::ports;
use crate::shared::atomic_words::into_words;
use crate::shared::light_box::LightBox;
use crate::shared::soft::Soft;
use fearless_simd::{Level, dispatch};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, KEPT, NO_CELL};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// View-samples that one task takes at most.
const TASK: usize = 1024;
/// Choices of a light sample to count from before a view-sample is left to single tests.
const CHOICES: usize = 3;

/// Whether nothing about a caster keeps it from having edges.
fn is_finite(corners: &[[f32; 3]; 3]) -> bool {
    corners.as_flattened().iter().all(|x| x.is_finite())
}

/// The edges of all casters of `soft`.
pub fn edges_of(soft: &Soft) -> Edges {
    Edges::new(soft.triangles, |id| soft.caster_state[id] != 0 && is_finite(&soft.triangles[id]))
}

/// Masks `[P ceil(L/32)]` on instruction set `level`, with the edges of all casters.
pub fn masks(soft: &Soft, edges: &Edges, level: Level, progress: &(dyn Fn(u64, u64) + Sync)) -> (Vec<u32>, Counts) {
    let words = soft.light.words();
    let base = |row: usize| match soft.sample_state[row / words] {
        BACKGROUND | KEPT => 0,
        _ => u32::MAX,
    };
    let masks: Vec<AtomicU32> = (0..soft.position.len() * words)
        .into_par_iter()
        .with_min_len(1 << 14)
        .map(|row| AtomicU32::new(base(row)))
        .collect();
    if words == 0 {
        return (into_words(masks), Counts::default());
    }
    let casts = |id: usize| soft.caster_state[id] != 0;
    let everyone: Vec<u32> = (0..soft.triangles.len()).filter(|id| casts(*id)).map(|id| id as u32).collect();
    let unlisted: Vec<u32> = (0..soft.position.len() as u32)
        .filter(|row| soft.sample_state[*row as usize] == KEPT && soft.cell[*row as usize] == NO_CELL)
        .collect();
    let choices = choices(&soft.light);
    let by_cell = soft.listed.chunk_by(|a, b| soft.cell[*a as usize] == soft.cell[*b as usize]);
    let tasks: Vec<(&[u32], bool)> = by_cell
        .flat_map(|rows| rows.chunks(TASK))
        .map(|rows| (rows, true))
        .chain(unlisted.chunks(TASK).map(|rows| (rows, false)))
        .collect();
    let (done, total) = (AtomicU64::new(0), (soft.listed.len() + unlisted.len()) as u64);
    let counts = tasks
        .par_iter()
        .map_init(
            || Worker::new(soft, edges, &choices),
            |worker, (rows, listed)| {
                worker.counts = Counts::default();
                let casters = if *listed { soft.casters_of(rows[0] as usize) } else { &everyone };
                dispatch!(level, simd => worker.cell(simd, rows, casters, &masks));
                let count = rows.len() as u64;
                progress(done.fetch_add(count, Relaxed) + count, total);
                worker.counts
            },
        )
        .reduce(Counts::default, Counts::plus);
    (into_words(masks), counts)
}

/// The light sample nearest the middle, and others.
pub(super) fn choices(light: &LightBox) -> Vec<usize> {
    let distance = |at: &usize| {
        let sample = light.samples[*at];
        (0..3).map(|k| (f64::from(sample[k]) - f64::from(light.middle[k])).powi(2)).sum::<f64>()
    };
    let count = light.samples.len();
    let nearest = (0..count).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
    let choices = CHOICES.min(count);
    (0..choices).map(|k| (nearest + k * count / choices) % count).collect()
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let soft = Soft::new(cx, LightBox::clustered(cx.input(input::LIGHT_SAMPLES.name).as_vec3()));
    let (mask, counts) = masks(&soft, &edges_of(&soft), Level::new(), cx.progress());
    cx.put(ports::MASK.name, Array::u32([soft.position.len(), soft.light.words()], mask));
    cx.count("gathered", counts.gathered);
    cx.count("borders", counts.borders);
    cx.count("recounted", counts.recounted);
    cx.count("near", counts.near);
    cx.count("crossing", counts.crossing);
    cx.count("whole_rows", counts.whole);
    cx.count("counted_rows", counts.counted);
    cx.count("left_rows", counts.left);
    cx.count("single", counts.single);
    cx.count("exact", counts.exact);
    Ok(())
}
