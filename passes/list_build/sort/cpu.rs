//! Sorting (cell, view-sample) pairs by least significant digits, and ranks from runs of equal cells.

use crate::list_build::Lists;
use crate::list_build::place::{Samples, keep_far};
use crate::shared::atomic_words::{atomic_zeros, into_words};
use rayon::prelude::*;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::NO_CELL;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// Most bits of a digit: its counters stay in the first-level cache.
const DIGIT_BITS: u32 = 11;
/// Fewest pairs worth a task of their own.
const CHUNK: usize = 1 << 14;

/// Cells, slots, lengths and depths.
pub fn sort(samples: &Samples) -> Lists {
    let cell_count = samples.cell_count();
    let far = atomic_zeros(cell_count);
    let (cell, slot, unplaced) = samples.each(|cell, depth| {
        keep_far(&far[cell], depth);
        0
    });
    let sorted = by_cell(&cell, cell_count);
    let slot: Vec<AtomicU32> = slot.into_iter().map(AtomicU32::new).collect();
    let length = atomic_zeros(cell_count);
    rank(
        &sorted,
        |view_sample, rank| slot[view_sample].store(rank, Relaxed),
        |cell, run| {
            length[cell].store(run, Relaxed);
        },
    );
    Lists {
        cell,
        slot: into_words(slot),
        length: into_words(length),
        far: bytemuck::cast_vec(into_words(far)),
        unplaced,
    }
}

/// Pairs of cell (high half) and view-sample (low half), ascending; view-samples in no cell are left out.
pub fn by_cell(cells: &[u32], cell_count: usize) -> Vec<u64> {
    let pair = |(index, cell): (usize, &u32)| (*cell != NO_CELL).then_some(u64::from(*cell) << 32 | index as u64);
    let pairs = cells.par_iter().enumerate();
    let mut pairs: Vec<u64> = pairs.filter_map(pair).collect();
    let key_bits = usize::BITS - cell_count.saturating_sub(1).leading_zeros();
    let digits = key_bits.div_ceil(DIGIT_BITS);
    let bits = if digits == 0 { 0 } else { key_bits.div_ceil(digits) };
    for digit in 0..digits {
        pairs = by_digit(&pairs, 32 + digit * bits, bits);
    }
    pairs
}

/// Pairs in order of `bits` bits from `shift`; equal ones keep their order.
fn by_digit(pairs: &[u64], shift: u32, bits: u32) -> Vec<u64> {
    let digit = |pair: u64| (pair >> shift) as usize & ((1 << bits) - 1);
    let chunk = pairs.len().div_ceil(rayon::current_num_threads()).max(CHUNK);
    let count = |chunk: &[u64]| {
        let mut counts = vec![0usize; 1 << bits];
        chunk.iter().for_each(|pair| counts[digit(*pair)] += 1);
        counts
    };
    let mut starts: Vec<Vec<usize>> = pairs.par_chunks(chunk).map(count).collect();
    // Counts become starts: digit by digit, and within a digit chunk by chunk, which keeps the sort stable.
    let mut start = 0;
    for digit in 0..1 << bits {
        for chunk in &mut starts {
            start += std::mem::replace(&mut chunk[digit], start);
        }
    }
    let sorted: Vec<AtomicU64> = vec![0; pairs.len()].into_iter().map(AtomicU64::new).collect();
    pairs.par_chunks(chunk).zip(starts).for_each(|(pairs, mut starts)| {
        for pair in pairs {
            let next = &mut starts[digit(*pair)];
            sorted[*next].store(*pair, Relaxed);
            *next += 1;
        }
    });
    sorted.into_iter().map(AtomicU64::into_inner).collect()
}

/// Calls `give` with view-sample and rank of every pair, and `close` with cell and length of every run of equal cells.
fn rank(sorted: &[u64], give: impl Fn(usize, u32) + Sync, close: impl Fn(usize, u32) + Sync) {
    let cell = |at: usize| (sorted[at] >> 32) as usize;
    sorted.par_chunks(CHUNK).enumerate().for_each(|(chunk, pairs)| {
        let first = chunk * CHUNK;
        // The run that reaches into this chunk may have begun in an earlier one.
        let mut start = sorted[..first].partition_point(|pair| ((pair >> 32) as usize) < cell(first));
        for (at, pair) in (first..).zip(pairs) {
            if cell(at) != cell(start) {
                start = at;
            }
            give(*pair as u32 as usize, (at - start) as u32);
            if at + 1 == sorted.len() || cell(at + 1) != cell(at) {
                close(cell(at), (at + 1 - start) as u32);
            }
        }
    });
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    sort(&Samples::of(cx)).put(cx);
    Ok(())
}
