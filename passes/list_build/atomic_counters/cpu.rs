//! Counting over all view-samples at once.

use crate::list_build::Lists;
use crate::list_build::place::{Samples, keep_far};
use crate::shared::atomic_words::{atomic_zeros, into_words};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;
use std::sync::atomic::Ordering::Relaxed;

/// Cells, slots, lengths and depths. No count orders any other memory: they are read once all threads are done.
pub fn count(samples: &Samples) -> Lists {
    let length = atomic_zeros(samples.cell_count());
    let far = atomic_zeros(samples.cell_count());
    let (cell, slot, unplaced) = samples.each(|cell, depth| {
        keep_far(&far[cell], depth);
        length[cell].fetch_add(1, Relaxed)
    });
    Lists { cell, slot, length: into_words(length), far: bytemuck::cast_vec(into_words(far)), unplaced }
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    count(&Samples::of(cx)).put(cx);
    Ok(())
}
