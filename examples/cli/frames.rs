//! Frames that have light samples of their own, averaged while nothing moves (Sintorn 2008, section 4.2, Figure 7).
//!
//! Kept are means of pictures and of visible shares, and values that are the same in all frames (view-samples). Masks and all that
//! depends on single light samples are left out. The mean begins anew with the first frame of another [`Standing`].

use crate::kept::Kept;
use crate::outcome::Outcome;
use shadowgraph_core::accumulation::Standing;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Plan, SlotId};

/// Outcomes of the frames so far as one.
pub struct Frames {
    outcome: Outcome,
    /// By slot.
    kept: Vec<Kept>,
    count: u32,
    standing: Option<Standing>,
}

impl Frames {
    /// None yet.
    pub fn new(plan: &Plan) -> Self {
        Self { outcome: Outcome::new(plan), kept: Kept::of(plan), count: 0, standing: None }
    }

    /// Takes a frame in and returns how many frames the means are of.
    pub fn add(&mut self, mut frame: Outcome, standing: Standing) -> u32 {
        if self.standing != Some(standing) {
            (self.standing, self.count) = (Some(standing), 0);
        }
        for (slot, kept) in self.kept.iter_mut().enumerate() {
            kept.add(frame.values.take(slot), standing, self.count == 0);
        }
        self.outcome.append_times(frame);
        self.count += 1;
        self.count
    }

    /// The mean of the value in `slot`; none where it has none or there is no frame.
    pub fn mean(&self, slot: SlotId) -> Option<Array> {
        self.kept[slot].mean()
    }

    /// Means and steady values as of one run, whose times are those of all frames.
    pub fn finish(mut self) -> Outcome {
        for (slot, kept) in self.kept.into_iter().enumerate() {
            if let Some(array) = kept.value() {
                self.outcome.values.put(slot, array);
            }
        }
        self.outcome
    }
}
