//! Lists of casters that may matter to a shaft, as a stack of rows: a shaft's list lies above that of the shaft it is part of.

use super::LANES;
use super::shaft::load;
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16, mask32x16, u32x16};

/// First corner, two edges, bounds on errors of edge functions, of the plane, and of corners.
pub const ROWS: usize = 12;

/// The stack. Rows are longer than `len` by sixteen and more, so that whole registers can be read and written anywhere.
#[derive(Default)]
pub struct Candidates {
    /// Row by row, in the cluster's own space.
    pub rows: [Vec<f32>; ROWS],
    /// What the cluster knows the caster by.
    pub slot: Vec<u32>,
    /// What the shaft that put it here found ([`super::patches`]).
    pub flags: Vec<u32>,
    /// Candidates on the stack.
    pub len: usize,
}

impl Candidates {
    /// Makes room for `more`.
    pub fn reserve(&mut self, more: usize) {
        let needed = self.len + more + 2 * LANES;
        if self.slot.len() < needed {
            let length = needed.next_power_of_two();
            self.slot.resize(length, 0);
            self.flags.resize(length, 0);
            for row in &mut self.rows {
                row.resize(length, 0.0);
            }
        }
    }

    /// Puts those of sixteen that `keep` names on the stack; room must have been made.
    #[inline(always)]
    pub fn push<S: Simd>(&mut self, simd: S, rows: [f32x16<S>; ROWS], slot: u32x16<S>, flags: u32x16<S>, keep: u16) {
        let mask = mask32x16::from_bitmask(simd, u64::from(keep));
        let at = self.len..self.len + LANES;
        for k in 0..ROWS {
            rows[k].compress(mask).store_slice(&mut self.rows[k][at.clone()]);
        }
        slot.compress(mask).store_slice(&mut self.slot[at.clone()]);
        flags.compress(mask).store_slice(&mut self.flags[at]);
        self.len += keep.count_ones() as usize;
    }

    /// The same for sixteen that lie on the stack.
    #[inline(always)]
    pub fn push_from<S: Simd>(&mut self, simd: S, place: usize, keep: u16, flags: u32x16<S>) {
        let mut rows = [f32x16::splat(simd, 0.0); ROWS];
        for k in 0..ROWS {
            rows[k] = load(simd, &self.rows[k], place);
        }
        let slot = u32x16::from_slice(simd, &self.slot[place..place + LANES]);
        self.push(simd, rows, slot, flags, keep);
    }

    /// Copies one over another.
    pub fn copy(&mut self, from: usize, to: usize) {
        for row in &mut self.rows {
            row[to] = row[from];
        }
        self.slot[to] = self.slot[from];
        self.flags[to] = self.flags[from];
    }

    /// First corner and both edges.
    #[inline(always)]
    pub fn caster(&self, place: usize) -> [[f32; 3]; 3] {
        let row = |k: usize| self.rows[k][place];
        [[row(0), row(1), row(2)], [row(3), row(4), row(5)], [row(6), row(7), row(8)]]
    }
}
