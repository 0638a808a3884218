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
use crate::kept::Kept;
use crate::outcome::Outcome;
use shadowgraph_core::accumulation::Standing;
use shadowgraph_core::plan::Plan;
use shadowgraph_core::problem::Problem;
use shadowgraph_cpu::Progress;

/// Runs `plan`, made for `job`, on `sets` disjoint sets of as many light samples as the job has. Times are
/// those of all sets together.
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
    let mut kept = Kept::of(plan);
    for (index, job) in job.in_sets(sets)?.enumerate() {
        let progress = |node: &str, done, total| progress(&format!("set {} of {sets}: {node}", index + 1), done, total);
        let mut one = machine.run(plan, &job, 1, &progress)?;
        for (slot, kept) in kept.iter_mut().enumerate() {
            // Nothing moves between the runs.
            kept.add(one.values.take(slot), Standing(0), index == 0);
        }
        outcome.add_run(one);
    }
    for (slot, kept) in kept.into_iter().enumerate() {
        if let Some(array) = kept.value() {
            outcome.values.put(slot, array);
        }
    }
    Ok(outcome)
}
