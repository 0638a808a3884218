//! What is left of one value after several runs with light samples of their own: its mean, or itself where no run changes it.

use shadowgraph_core::accumulation::{Accumulation, Standing};
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::Plan;

/// Quantities that have a mean over light samples.
const MEANS: &[&str] = &["radiance", "fraction", "light_share"];

/// What is left of one value.
#[derive(Default)]
pub struct Kept {
    /// Of a value that has one.
    mean: Option<Accumulation>,
    /// The first run's, until another run's differs.
    same: Option<Array>,
}

impl Kept {
    /// One for each slot of `plan`.
    pub fn of(plan: &Plan) -> Vec<Self> {
        let has_mean = |quantity: &str| MEANS.contains(&quantity).then(Accumulation::default);
        plan.slots.iter().map(|slot| Self { mean: has_mean(slot.port.quantity), same: None }).collect()
    }

    /// Takes the value of a run in, the `first` of those under one `standing`.
    pub fn add(&mut self, value: Option<Array>, standing: Standing, first: bool) {
        match (&mut self.mean, value) {
            (Some(mean), Some(array)) => _ = mean.add(standing, &array),
            (_, value) if first => self.same = value,
            (_, value) => self.same = self.same.take().filter(|same| value.as_ref() == Some(same)),
        }
    }

    /// The mean; none where the value has none or there was no run.
    pub fn mean(&self) -> Option<Array> {
        self.mean.as_ref().and_then(Accumulation::mean)
    }

    /// The mean, or the value that all runs share.
    pub fn value(self) -> Option<Array> {
        self.mean().or(self.same)
    }
}
