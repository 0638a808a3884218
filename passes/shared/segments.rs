//! Masks from one yes-or-no question for each (view-sample, light sample): the frame of every pass that walks segments.

use rayon::prelude::*;
use shadowgraph_core::shared::{BACKGROUND, KEPT};
use std::sync::atomic::{AtomicU64, Ordering};

/// View-samples that one thread answers at a time.
const CHUNK_ROWS: usize = 1024;

/// Words a mask of `light_sample_count` bits takes.
pub fn mask_words(light_sample_count: usize) -> usize {
    light_sample_count.div_ceil(32)
}

/// Masks `[P, mask_words]` of view-samples in these states: background none, kept as `blocked` answers for (view-sample,
/// light sample), all others full, unused bits too. Each thread answers with a worker of its own; their end states come
/// back in the order of the view-samples.
pub fn masks<W: Default + Send>(
    states: &[u32],
    light_sample_count: usize,
    progress: &(dyn Fn(u64, u64) + Sync),
    blocked: impl Fn(&mut W, usize, usize) -> bool + Sync,
) -> (Vec<u32>, Vec<W>) {
    let words = mask_words(light_sample_count);
    if words == 0 {
        return (Vec::new(), Vec::new());
    }
    let mut masks = vec![0; states.len() * words];
    let (done, total) = (AtomicU64::new(0), states.len() as u64);
    let workers = masks
        .par_chunks_mut(CHUNK_ROWS * words)
        .zip(states.par_chunks(CHUNK_ROWS))
        .enumerate()
        .map(|(chunk, (masks, states))| {
            let mut worker = W::default();
            for (index, (mask, state)) in masks.chunks_exact_mut(words).zip(states).enumerate() {
                match *state {
                    BACKGROUND => {}
                    KEPT => {
                        let row = chunk * CHUNK_ROWS + index;
                        for sample in 0..light_sample_count {
                            mask[sample / 32] |= u32::from(blocked(&mut worker, row, sample)) << (sample % 32);
                        }
                    }
                    _ => mask.fill(u32::MAX),
                }
            }
            let rows = states.len() as u64;
            progress(done.fetch_add(rows, Ordering::Relaxed) + rows, total);
            worker
        })
        .collect();
    (masks, workers)
}
