//! Rows of look-up tables: all distances of one direction, in one walk over the light samples.
//!
//! Along a row the plane moves and light samples fall behind it one after the other: each is put at the first bin where its bit is set,
//! and a running OR does the rest.

use super::lu::{BLOCK, Layout};
use rayon::prelude::*;

/// Slack of what is certain over a bin, of R: rounding of offsets, angles and distances on either backend, with ample room.
pub const CERTAIN_SLACK: f32 = 3e-4;

/// A direction's bin: sines and cosines of its middle, and of half its width.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// sin theta, cos theta.
    pub theta: [f32; 2],
    /// sin phi, cos phi.
    pub phi: [f32; 2],
    /// sin and cos of half a bin of theta.
    pub half_theta: [f32; 2],
    /// sin and cos of half a bin of phi.
    pub half_phi: [f32; 2],
}

fn sin_cos(turn: f64) -> [f32; 2] {
    let (sin, cos) = turn.sin_cos();
    [sin as f32, cos as f32]
}

impl Direction {
    /// Bin (`theta`, `phi`) of `size` along each.
    pub fn new(theta: usize, phi: usize, size: usize) -> Self {
        let pi = std::f64::consts::PI;
        let size = size as f64;
        Self {
            theta: sin_cos(pi * (theta as f64 + 0.5) / size),
            phi: sin_cos(2.0 * pi * (phi as f64 + 0.5) / size - pi),
            half_theta: sin_cos(0.5 * pi / size),
            half_phi: sin_cos(pi / size),
        }
    }

    /// The unit normal at the middle.
    pub fn normal(&self) -> [f32; 3] {
        let [sin, cos] = self.theta;
        [sin * self.phi[1], sin * self.phi[0], cos]
    }

    /// Smallest and largest n . s over all directions of the bin.
    ///
    /// A cos delta + B sin delta for |delta| up to h lies within [min(A, A cos h) - |B| sin h, max(A, A cos h) + |B| sin h]; once for phi,
    /// then for theta, sin theta being no less than zero.
    pub fn range(&self, [x, y, z]: [f32; 3]) -> [f32; 2] {
        let ends = |at: f32, along: f32, [sin, cos]: [f32; 2]| {
            let spread = along.abs() * sin;
            [at.min(at * cos) - spread, at.max(at * cos) + spread]
        };
        let [sin, cos] = self.phi;
        let flat = ends(x * cos + y * sin, y * cos - x * sin, self.half_phi);
        let [sin, cos] = self.theta;
        let of = |flat: f32| ends(flat * sin + z * cos, flat * cos - z * sin, self.half_theta);
        [of(flat[0])[0], of(flat[1])[1]]
    }
}

/// The first bin of `size` whose middle puts a light sample with n . s / R = `along` inside; `size` if none does.
pub fn first_inside(along: f32, size: usize) -> usize {
    // along + (2 k + 1) / size - 1 >= 0.
    first(((1.0 - along) * size as f32 - 1.0) * 0.5, size)
}

/// The first bin all of which puts a light sample with n . s / R at least `low` inside.
pub fn first_certain(low: f32, size: usize) -> usize {
    // low + 2 k / size - 1 >= slack.
    first((1.0 - low + CERTAIN_SLACK) * size as f32 * 0.5, size)
}

/// The first bin any of which may put a light sample with n . s / R at most `high` inside.
pub fn first_possible(high: f32, size: usize) -> usize {
    // high + 2 (k + 1) / size - 1 >= -slack.
    first((1.0 - high - CERTAIN_SLACK) * size as f32 * 0.5 - 1.0, size)
}

fn first(at: f32, size: usize) -> usize {
    (at.ceil().max(0.0) as usize).min(size)
}

/// Fills `row`, `size` entries of Q words: `firsts` gives for an offset over R the first bin of its bit in each group of four words.
fn fill_row<const GROUPS: usize>(row: &mut [u32], offsets: &[[f32; 3]], firsts: impl Fn([f32; 3]) -> [usize; GROUPS]) {
    row.fill(0);
    let entry = 4 * GROUPS;
    for (place, offset) in offsets.iter().enumerate() {
        for (group, bin) in firsts(*offset).into_iter().enumerate() {
            if let Some(word) = row.get_mut(bin * entry + group * 4 + place / 32) {
                *word |= 1 << (place % 32);
            }
        }
    }
    for at in entry..row.len() {
        row[at] |= row[at - entry];
    }
}

/// The rows of a table along its first coordinates: how many, and which one holds the opposite direction.
#[derive(Clone, Copy)]
pub struct Rows {
    /// Rows of a block.
    pub count: usize,
    /// Bins along a coordinate.
    pub size: usize,
    /// Row of the opposite direction.
    pub opposite: fn(usize, usize) -> usize,
}

/// A whole table `[K rows size Q]`. Rows of the first half are filled from `firsts` with what `direction` prepares for the row; the rest
/// are mirrored: entry k of the opposite direction is the complement of entry `size` - 1 - k, groups exchanged.
pub fn fill<const GROUPS: usize, D>(
    layout: &Layout,
    samples: &[[f32; 3]],
    rows: Rows,
    direction: impl Fn(usize) -> D + Sync,
    firsts: impl Fn(&D, [f32; 3]) -> [usize; GROUPS] + Sync,
) -> Vec<u32> {
    let Rows { count, size, opposite } = rows;
    let entry = 4 * GROUPS;
    let row_words = size * entry;
    let offsets: Vec<[f32; 3]> = samples.iter().map(|sample| layout.offset(*sample)).collect();
    let mut words = vec![0; samples.len().div_ceil(BLOCK) * count * row_words];
    words.par_chunks_mut(row_words.max(1)).enumerate().with_min_len(16).for_each(|(index, out)| {
        let (block, row) = (index / count, index % count);
        let offsets = &offsets[block * BLOCK..offsets.len().min((block + 1) * BLOCK)];
        let is_mirrored = 2 * row >= count;
        let direction = direction(if is_mirrored { opposite(row, size) } else { row });
        if !is_mirrored {
            fill_row(out, offsets, |offset| firsts(&direction, offset));
            return;
        }
        let mut mirrored = vec![0; row_words];
        fill_row(&mut mirrored, offsets, |offset| firsts(&direction, offset));
        for (out, source) in out.chunks_exact_mut(entry).zip(mirrored.chunks_exact(entry).rev()) {
            for (word, out) in out.iter_mut().enumerate() {
                *out = !source[(word + entry - 4) % entry];
            }
        }
    });
    words
}

/// Row of the opposite direction, rows counted along theta, then phi.
pub fn opposite_direction(row: usize, size: usize) -> usize {
    let (theta, phi) = (row / size, row % size);
    (size - 1 - theta) * size + (phi + size / 2) % size
}

/// Row of the opposite direction, rows counted along phi.
pub fn opposite_line(row: usize, size: usize) -> usize {
    (row + size / 2) % size
}
