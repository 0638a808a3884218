//! Which cell each view-sample falls in: the first step of both passes.

use crate::ports;
use crate::shared::light_frame::{Face, cells_of, faces};
use rayon::prelude::*;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::shared::{KEPT, NO_CELL};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// View-samples one task takes: long enough to hide the hand-over, short enough to share out.
const CHUNK: usize = 1 << 13;
/// View-samples placed before any is counted: the two loops run better apart.
const BLOCK: usize = 256;

/// What the passes of this stage read.
pub struct Samples<'a> {
    /// World space.
    pub positions: &'a [[f32; 3]],
    /// See `sample_state`.
    pub states: &'a [u32],
    /// Of the light frame.
    pub faces: Vec<Face>,
    /// Light texels a side.
    pub side: usize,
}

impl<'a> Samples<'a> {
    /// From the ports.
    pub fn of(cx: &CpuCx<'a>) -> Self {
        Self {
            positions: cx.input(ports::POSITION.name).as_vec3(),
            states: cx.input(ports::SAMPLE_STATE.name).as_u32(),
            faces: faces(cx.input(ports::LIGHT_FRAME.name).as_f32()),
            side: cx.params().u32(super::SIZE.name) as usize,
        }
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.faces.len() * self.side * self.side
    }

    /// Calls `list` with cell and depth of every placed view-sample, in parallel, and stores what it returns as its slot.
    /// Returns the cells, the slots and how many kept view-samples no face sees.
    pub fn each(&self, list: impl Fn(usize, f32) -> u32 + Sync) -> (Vec<u32>, Vec<u32>, u64) {
        let count = self.positions.len();
        let (mut cells, mut slots) = (vec![0; count], vec![0; count]);
        let chunks = cells.par_chunks_mut(BLOCK).zip(slots.par_chunks_mut(BLOCK));
        let chunks = chunks.zip(self.positions.par_chunks(BLOCK)).zip(self.states.par_chunks(BLOCK));
        let unplaced = chunks.with_min_len(CHUNK / BLOCK).map(|(((cells, slots), positions), states)| {
            let mut depths = [0.0; BLOCK];
            cells_of(&self.faces, positions, self.side, cells, &mut depths);
            let mut unplaced = 0;
            for (((cell, slot), depth), state) in cells.iter_mut().zip(slots).zip(depths).zip(states) {
                if *state == KEPT && depth > 0.0 {
                    *slot = list(*cell as usize, depth);
                } else {
                    *cell = NO_CELL;
                    unplaced += u64::from(*state == KEPT);
                }
            }
            unplaced
        });
        let unplaced = unplaced.sum();
        (cells, slots, unplaced)
    }
}

/// Keeps the larger of `depth` and the stored depth; both above zero, so their bits are ordered as they are. Most
/// view-samples are not the furthest so far: looking first saves the exchange.
#[inline]
pub fn keep_far(far: &AtomicU32, depth: f32) {
    let bits = depth.to_bits();
    if far.load(Relaxed) < bits {
        far.fetch_max(bits, Relaxed);
    }
}
