//! What a run gives back, whichever backends ran it.

use serde::Serialize;
use shadowgraph_core::plan::{Node, Plan};
use shadowgraph_cpu::Store;

/// Values by slot, and what each node did.
#[derive(Debug)]
pub struct Outcome {
    /// Kept values, by slot.
    pub values: Store,
    /// Nodes in the order of the plan.
    pub nodes: Vec<NodeRecord>,
    /// Whole runs, host clock, milliseconds, in order of time: see [`crate::stretch::Frame::millis`] for what counts; one median of all where the device repeated them.
    pub frames_millis: Vec<f64>,
    /// Timed runs; with more than one there was a warm-up.
    pub runs_count: u32,
}

impl Outcome {
    /// Of a plan that has not run.
    pub fn new(plan: &Plan) -> Self {
        let record = |node: &Node| NodeRecord {
            node: node.id.clone(),
            stage: node.pass.stage.name,
            pass: node.pass.name,
            on: node.on,
            clock: "",
            millis: Vec::new(),
            bytes: 0,
            counts: Vec::new(),
        };
        Self {
            values: Store::new(plan),
            nodes: plan.nodes.iter().map(record).collect(),
            frames_millis: Vec::new(),
            runs_count: 0,
        }
    }

    /// Adds the times of a further run of the same plan; bytes and counts are the last run's.
    pub fn append_times(&mut self, other: Self) {
        self.frames_millis.extend(other.frames_millis);
        self.runs_count += other.runs_count;
        for (node, mut other) in self.nodes.iter_mut().zip(other.nodes) {
            let mut millis = std::mem::take(&mut node.millis);
            millis.append(&mut other.millis);
            *node = NodeRecord { millis, ..other };
        }
    }

    /// Takes another run of the same plan for a further part of this one: times add up, bytes and counts are the last run's.
    pub fn add_run(&mut self, other: Self) {
        let sum = |times: &[f64], more: &[f64]| vec![times.iter().chain(more).sum()];
        self.frames_millis = sum(&self.frames_millis, &other.frames_millis);
        self.runs_count = 1;
        for (node, other) in self.nodes.iter_mut().zip(other.nodes) {
            let millis = sum(&node.millis, &other.millis);
            *node = NodeRecord { millis, ..other };
        }
    }
}

/// One node in a run's record.
#[derive(Clone, Debug, Serialize)]
pub struct NodeRecord {
    /// Id in the graph file.
    pub node: String,
    /// Stage.
    pub stage: &'static str,
    /// Pass.
    pub pass: &'static str,
    /// Backend.
    pub on: shadowgraph_core::plan::Backend,
    /// Whose clock, and what it measured.
    pub clock: &'static str,
    /// Time of each run, milliseconds.
    pub millis: Vec<f64>,
    /// Size of its outputs.
    pub bytes: usize,
    /// Counts by name.
    pub counts: Vec<(&'static str, u64)>,
}

/// Median, smallest and largest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Median.
    pub median: f64,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Of `values`; zeros when there are none.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let Some((first, last)) = sorted.first().zip(sorted.last()) else {
            return Self { median: 0.0, min: 0.0, max: 0.0 };
        };
        let middle = sorted.len() / 2;
        let median = if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 };
        Self { median, min: *first, max: *last }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_odd_even_and_none() {
        assert_eq!(Spread::of(&[3.0, 1.0, 2.0]), Spread { median: 2.0, min: 1.0, max: 3.0 });
        assert_eq!(Spread::of(&[4.0, 1.0, 2.0, 3.0]).median, 2.5);
        assert_eq!(Spread::of(&[]).median, 0.0);
    }
}
