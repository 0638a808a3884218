//! Does a graph give the same values whatever must not matter: the order of its nodes, what memory held before, who shares it, how
//! often a frame ran, how many threads there are, in how many parts view-samples run?
//!
//! Every live port is compared with that of one plain run, as [`port_difference`] does for equal inputs: bits, and lists as sets,
//! whose order is unspecified. What differs first along the graph is named: a node whose inputs agree and whose outputs do not. A check
//! that has no meaning for a graph or a backend says so and why.

mod checks;
mod runs;
pub mod text;

use crate::engine::Machine;
use crate::job::Job;
use crate::port_difference::Comparison;
use crate::record::DeviceRecord;
use serde::Serialize;
use shadowgraph_core::plan::Plan;
use shadowgraph_core::problem::Problem;
use shadowgraph_cpu::Progress;

/// How much to try.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Shuffled orders.
    pub orders: u32,
    /// Frames of which the last is compared with the first.
    pub frames: u32,
    /// Parts that view-samples run in.
    pub ranges: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { orders: 3, frames: 10, ranges: 3 }
    }
}

/// A graph to check, planned twice.
#[derive(Clone, Copy, Debug)]
pub struct Plans<'a> {
    /// Every value is kept, so none shares memory.
    pub kept: &'a Plan,
    /// Only outputs are kept: transients share memory.
    pub shared: &'a Plan,
}

/// What all checks found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The graph.
    pub graph: String,
    /// Its stable number.
    pub graph_hash: String,
    /// The scene.
    pub scene: String,
    /// Picture width and height, pixels.
    pub size: [usize; 2],
    /// Where it ran.
    pub device: DeviceRecord,
    /// Outputs of its nodes.
    pub ports_count: usize,
    /// The checks.
    pub checks: Vec<Check>,
}

impl Report {
    /// Whether no check found a difference.
    pub fn is_invariant(&self) -> bool {
        self.checks.iter().all(|check| !matches!(check.verdict, Verdict::Differs { .. }))
    }
}

/// One check.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    /// What was changed: `order`, `poison`, `sharing`, ...
    pub check: &'static str,
    /// In detail.
    pub what: String,
    /// What came of it.
    pub verdict: Verdict,
}

/// What came of a check.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Verdict {
    /// Every compared port is the same.
    Same {
        /// Ports compared.
        compared_count: usize,
        /// Ports of which this check has nothing to compare.
        not_compared_count: usize,
    },
    /// Some are not.
    Differs {
        /// In the order of the graph.
        ports: Vec<Difference>,
    },
    /// The check means nothing here.
    NotApplicable {
        /// Why.
        why: String,
    },
}

/// A port that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The node.
    pub node: String,
    /// Its pass.
    pub pass: &'static str,
    /// Its port.
    pub port: &'static str,
    /// How.
    pub comparison: Comparison,
    /// Whether all that the node reads is the same, as far as it was compared: the fault is here. Else it may follow from a node before.
    pub begins_here: bool,
}

/// Runs all checks of `plans` on `job`.
///
/// # Errors
/// As [`Machine::run`].
pub fn check(
    machine: &Machine,
    plans: Plans,
    job: &Job,
    settings: &Settings,
    progress: &Progress,
) -> Result<Report, Problem> {
    Ok(Report {
        graph: plans.kept.name.clone(),
        graph_hash: shadowgraph_graph::plan_id(plans.kept),
        scene: job.scene_spec.clone(),
        size: job.image,
        device: machine.record(),
        ports_count: plans.kept.nodes.iter().map(|node| node.outputs.len()).sum(),
        checks: checks::all(machine, plans, job, settings, progress)?,
    })
}
