//! Frames that have light samples of their own, averaged while nothing moves (Sintorn 2008, section 4.2, Figure 7).
//!
//! Kept are means of pictures and of visible shares, and values that are the same in all frames (view-samples). Masks and all that
//! depends on single light samples are left out. The mean begins anew with the first frame of another [`Standing`].

use crate::converged::MEANS;
use crate::outcome::Outcome;
use shadowgraph_core::accumulation::{Accumulation, Standing};
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Plan, SlotId};

/// Outcomes of the frames so far as one.
pub struct Frames<'p> {
    plan: &'p Plan,
    outcome: Outcome,
    /// Where a value has a mean, by slot.
    means: Vec<Option<Accumulation>>,
    /// Of the other values, those that no frame has changed, by slot.
    steady: Vec<Option<Array>>,
    count: u32,
    standing: Option<Standing>,
}

impl<'p> Frames<'p> {
    /// None yet.
    pub fn new(plan: &'p Plan) -> Self {
        let has_mean = |slot: SlotId| MEANS.contains(&plan.slots[slot].port.quantity);
        let means = (0..plan.slots.len()).map(|slot| has_mean(slot).then(Accumulation::default)).collect();
        let (steady, outcome) = (vec![None; plan.slots.len()], Outcome::new(plan));
        Self { plan, outcome, means, steady, count: 0, standing: None }
    }

    /// Takes a frame in and returns how many frames the means are of.
    pub fn add(&mut self, mut frame: Outcome, standing: Standing) -> u32 {
        if self.standing != Some(standing) {
            (self.standing, self.count) = (Some(standing), 0);
        }
        for slot in 0..self.plan.slots.len() {
            let value = frame.values.take(slot);
            match (&mut self.means[slot], value) {
                (Some(mean), Some(array)) => {
                    mean.add(standing, &array);
                }
                (_, value) if self.count == 0 => self.steady[slot] = value,
                (_, value) => {
                    self.steady[slot] = self.steady[slot].take().filter(|first| value.as_ref() == Some(first))
                }
            }
        }
        self.outcome.append_times(frame);
        self.count += 1;
        self.count
    }

    /// The mean of the value in `slot`; none where it has none or there is no frame.
    pub fn mean(&self, slot: SlotId) -> Option<Array> {
        self.means[slot].as_ref().and_then(Accumulation::mean)
    }

    /// Means and steady values as of one run, whose times are those of all frames.
    pub fn finish(mut self) -> Outcome {
        for slot in 0..self.plan.slots.len() {
            if let Some(array) = self.mean(slot).or(self.steady[slot].take()) {
                self.outcome.values.put(slot, array);
            }
        }
        self.outcome
    }
}
