//! Answers from more light samples than one run takes: the mean over runs with disjoint sets of them.
//!
//! A set has as many light samples as a run; together the sets are one large set of the light's generator, which converges as such
//! (Hammersley points: an error of about N^-0.77 where a light is partly visible), not as independent runs do. 16 sets of 4096 make
//! 65,536. Sets count alike: the mean of pictures, and of `visible` by `combine/popcount`, is that of all light samples; of `visible`
//! by `combine/weighted` under a textured light only nearly, as its luminance is not the same in each set.
//!
//! Kept are means of pictures and of visible shares, and values that are the same in all runs (view-samples). Masks and all that
//! depends on single light samples are left out.

use crate::engine::Machine;
use crate::job::Job;
use crate::outcome::Outcome;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Plan, SlotId};
use shadowgraph_core::problem::Problem;
use shadowgraph_cpu::Progress;

/// Quantities that have a mean over light samples.
const MEANS: &[&str] = &["radiance", "fraction", "light_share"];

/// Runs `plan`, made for `job`, on `sets` disjoint sets of as many light samples as the job has. Times are those of the runs, one
/// a set.
///
/// # Errors
/// The light cannot be sampled so often; what a node reports.
pub fn converged(
    machine: &Machine,
    plan: &Plan,
    job: &Job,
    sets: usize,
    progress: &Progress,
) -> Result<Outcome, Problem> {
    let mut outcome = Outcome::new(plan);
    let mut means: Vec<Mean> = Vec::new();
    for (index, job) in job.in_sets(sets)?.enumerate() {
        let progress = |node: &str, done, total| progress(&format!("set {} of {sets}: {node}", index + 1), done, total);
        let mut one = machine.run(plan, &job, 1, &progress)?;
        means.resize_with(plan.slots.len(), Mean::default);
        for (slot, mean) in means.iter_mut().enumerate() {
            mean.add(plan, slot, one.values.take(slot), index);
        }
        outcome.append_times(one);
    }
    for (slot, mean) in means.into_iter().enumerate() {
        if let Some(array) = mean.finish(sets) {
            outcome.values.put(slot, array);
        }
    }
    Ok(outcome)
}

/// The mean of one value over runs.
#[derive(Default)]
struct Mean {
    /// The first run's; none once another run's differs and there is no mean of it.
    first: Option<Array>,
    /// Where the value has a mean.
    sums: Option<Vec<f64>>,
}

impl Mean {
    fn add(&mut self, plan: &Plan, slot: SlotId, value: Option<Array>, run: usize) {
        let has_mean = MEANS.contains(&plan.slots[slot].port.quantity);
        if run == 0 {
            self.sums = value.as_ref().filter(|_| has_mean).map(|array| widened(array).collect());
            self.first = value;
            return;
        }
        match (&mut self.sums, value) {
            (Some(sums), Some(array)) => sums.iter_mut().zip(widened(&array)).for_each(|(sum, value)| *sum += value),
            (_, value) => self.first = self.first.take().filter(|first| value.as_ref() == Some(first)),
        }
    }

    fn finish(self, runs: usize) -> Option<Array> {
        let first = self.first?;
        Some(match self.sums {
            Some(sums) => {
                let mean = sums.iter().map(|sum| (sum / runs as f64) as f32).collect();
                Array::f32(first.shape().to_vec(), mean)
            }
            None => first,
        })
    }
}

fn widened(array: &Array) -> impl Iterator<Item = f64> + '_ {
    array.as_f32().iter().map(|value| f64::from(*value))
}
