//! Writing the rows of a table of lists to their places: `entries[offset[cell] + slot]` (Sintorn 2008, section 3.1, the
//! global array). Lists of view-samples and of casters are filled alike.

use crate::shared::atomic_words::{atomic_zeros, into_words};
use rayon::prelude::*;
use shadowgraph_core::record::Bind::{Read, Uniform};
use shadowgraph_core::record::{Bind, Target};
use std::sync::atomic::Ordering::Relaxed;

/// The same in WGSL, joined after `shared::PRELUDE`; takes bindings 0 to 3, see [`bindings`].
pub const WGSL: &str = include_str!("table_fill.wgsl");

/// Rows one task takes.
const CHUNK: usize = 1 << 14;

/// A table of `capacity` words with `entry(row)` at the place of every row. Rows whose cell is not below the number of
/// cells, and places past the capacity, are left out. Places that no row has are zero.
pub fn fill(
    cells: &[u32],
    slots: &[u32],
    offsets: &[u32],
    capacity: usize,
    entry: impl Fn(usize) -> u32 + Sync,
) -> Vec<u32> {
    let entries = atomic_zeros(capacity);
    // The last offset is the total, not the start of a list.
    let offsets = &offsets[..offsets.len() - 1];
    cells.par_chunks(CHUNK).zip(slots.par_chunks(CHUNK)).enumerate().for_each(|(chunk, (cells, slots))| {
        for ((cell, slot), row) in cells.iter().zip(slots).zip(chunk * CHUNK..) {
            let place = offsets.get(*cell as usize).map(|offset| *offset as usize + *slot as usize);
            if let Some(entry_at) = place.and_then(|place| entries.get(place)) {
                entry_at.store(entry(row), Relaxed);
            }
        }
    });
    into_words(entries)
}

/// Bindings 0 to 3 of a kernel that fills a table of `capacity` words from `rows` rows.
pub fn bindings(rows: usize, cells: usize, capacity: usize, cell: Target, slot: Target, offset: Target) -> Vec<Bind> {
    vec![Uniform(vec![rows as u32, cells as u32, capacity as u32]), Read(cell), Read(slot), Read(offset)]
}

#[cfg(test)]
mod tests {
    use super::fill;

    #[test]
    fn rows_go_to_offset_plus_slot() {
        // Three cells of lengths 2, 0, 1.
        let entries = fill(&[2, 0, u32::MAX, 0], &[0, 1, 0, 0], &[0, 2, 2, 3], 5, |row| 10 + row as u32);
        assert_eq!(entries, [13, 11, 10, 0, 0]);
    }

    #[test]
    fn nothing_is_written_past_the_capacity_or_for_a_cell_that_is_not_there() {
        assert_eq!(fill(&[0, 0, 1], &[0, 1, 0], &[0, 2], 1, |row| 7 + row as u32), [7]);
        assert_eq!(fill(&[0], &[u32::MAX], &[1, 2], 2, |_| 7), [0, 0]);
        assert_eq!(fill(&[], &[], &[0], 0, |_| 7), [0u32; 0]);
    }
}
