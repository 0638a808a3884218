//! Exclusive prefix sums, for the scan stage and for recipes that need one inside.
//!
//! `offsets[i]` is the sum of `lengths[..i]`; one more entry holds the total. On a GPU the sum is taken in levels: every
//! invocation sums a run of [`RUN`] entries, the sums are scanned likewise, and every invocation writes its run from where
//! its sum starts. Runs are serial because barriers cost more than loads on software rasterisers; only the topmost level,
//! one workgroup, shares memory (Sintorn 2008, section 3.1; Harris, Sengupta, Owens 2007, GPU Gems 3, chapter 39).

use rayon::prelude::*;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};

/// Entries one invocation sums.
pub const RUN: usize = 32;
/// Invocations of the topmost level's one workgroup; `TOP_GROUP` in the WGSL.
const TOP_GROUP: usize = 256;
/// Entries the topmost level takes: as many as its loops may run over cheaply.
const TOP: usize = TOP_GROUP * RUN;
/// Entries one CPU task sums: 64 KiB, so that the second walk over them finds them in the second-level cache.
const CHUNK: usize = 16_384;

const PIECES: &[&str] = &[shadowgraph_core::shared::PRELUDE, include_str!("scan.wgsl")];

/// Records an exclusive scan: `count` words of `lengths` to `count + 1` words of `offsets`, the last the total. Sums wrap
/// past 32 bits: the caller bounds them, as lists are bounded by the buffers they index. The targets must differ.
pub fn record_scan(cx: &mut GpuCx, lengths: Target, count: usize, offsets: Target) {
    if count <= TOP {
        // The topmost level has no blocks, but every entry point is given all four bindings.
        let blocks = cx.scratch("scan_unused", 1);
        let bind = bindings(count, count.div_ceil(TOP_GROUP), lengths, offsets, blocks);
        cx.dispatch("scan/top", PIECES, "scan_top", bind, TOP_GROUP, TOP_GROUP);
        return;
    }
    let block_count = count.div_ceil(RUN);
    let block_sum = cx.scratch("scan_block_sum", block_count);
    let block_offset = cx.scratch("scan_block_offset", block_count + 1);
    let bind = bindings(count, RUN, lengths, offsets, block_sum);
    cx.dispatch("scan/sum", PIECES, "scan_sum", bind, block_count, shadowgraph_core::shared::GROUP);
    record_scan(cx, block_sum, block_count, block_offset);
    let bind = bindings(count, RUN, lengths, offsets, block_offset);
    cx.dispatch("scan/add", PIECES, "scan_add", bind, block_count, shadowgraph_core::shared::GROUP);
}

fn bindings(count: usize, run: usize, lengths: Target, offsets: Target, blocks: Target) -> Vec<Bind> {
    vec![
        Bind::Uniform(vec![count as u32, run as u32]),
        Bind::Read(lengths),
        Bind::ReadWrite(offsets),
        Bind::ReadWrite(blocks),
    ]
}

/// The scan on the CPU, in two parallel walks: chunk sums, then offsets from each chunk's start.
///
/// # Errors
/// A total past 32 bits.
pub fn exclusive(lengths: &[u32]) -> Result<Vec<u32>, Problem> {
    let sum = |chunk: &[u32]| chunk.iter().map(|length| u64::from(*length)).sum::<u64>();
    let sums: Vec<u64> = lengths.par_chunks(CHUNK).map(sum).collect();
    let mut total = 0;
    let mut starts = Vec::with_capacity(sums.len());
    for sum in sums {
        starts.push(total);
        total += sum;
    }
    let total = fits(total)?;
    let mut offsets = vec![0; lengths.len() + 1];
    offsets[..lengths.len()].par_chunks_mut(CHUNK).zip(lengths.par_chunks(CHUNK)).zip(&starts).for_each(
        |((offsets, lengths), start)| {
            let mut running = *start as u32;
            for (offset, length) in offsets.iter_mut().zip(lengths) {
                *offset = running;
                running = running.wrapping_add(*length);
            }
        },
    );
    offsets[lengths.len()] = total;
    Ok(offsets)
}

/// A total as an offset.
///
/// # Errors
/// When it does not fit 32 bits.
pub fn fits(total: u64) -> Result<u32, Problem> {
    u32::try_from(total).map_err(|_| {
        Problem::new(Kind::Overflow, "the sum of all list lengths does not fit an offset of 32 bits")
            .port("length")
            .expected(format!("at most {}", u32::MAX))
            .found(total.to_string())
    })
}

#[cfg(test)]
#[path = "scan_tests.rs"]
mod tests;
