//! What each node of a graph costs: within whole frames and alone, with what it counted, its memory, and how far the clocks can be
//! trusted.
//!
//! **In frame** is a node's time inside a whole frame: caches as its neighbours left them, work of others beside it. **Alone** is the
//! same node by itself, again and again, on the values it had. Where the two [disagree](times::disagree), neither is the whole truth, and
//! the profile says so. Structures (lists, trees, tables) are built in every frame and counted like everything else.
//!
//! Timers cost: on wgpu every second frame runs with them off, and the difference is reported; the CPU's are two clock reads a node.

mod alone;
mod clocks;
pub mod csv;
mod frames;
pub mod overlap;
#[cfg(test)]
mod tests;
pub mod text;
pub mod times;
pub mod trace;

pub use clocks::{Clocks, TimerCost};

use crate::engine::Machine;
use crate::job::Job;
use crate::record::RunRecord;
use crate::trial::Trial;
use overlap::Overlap;
use serde::Serialize;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;
use shadowgraph_cpu::Progress;
use shadowgraph_wgpu::Options;
use shadowgraph_wgpu::statistics::NodeStatistics;
use times::{Series, Times, disagree};

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Measured frames, at least one; with timers, as many again without them where they cost something.
    pub frames: u32,
    /// Frames before, unmeasured, after the cold one.
    pub warm_up: u32,
    /// Runs of each node alone; 0 for none.
    pub alone: u32,
    /// Whether nodes are timed.
    pub timers: bool,
    /// Whether shaders are counted, in a frame of its own.
    pub statistics: bool,
}

/// A measured graph.
#[derive(Clone, Debug, Serialize)]
pub struct Profile {
    /// Where it comes from, and the cold frame before all others.
    pub cold: RunRecord,
    /// Unmeasured frames after the cold one.
    pub warm_up_count: u32,
    /// Whose clocks, and how far they can be trusted.
    pub clocks: Clocks,
    /// Whole frames as a host would run them, timers off; none where the CPU's timers, which cost nothing to speak of, were on.
    pub frame: Option<Times>,
    /// Whole frames with timers on.
    pub timed_frame: Option<Times>,
    /// How the nodes of a frame lie in time.
    pub overlap: Option<Overlap>,
    /// Device memory taken, bytes; none where nodes run on the CPU too.
    pub memory_bytes: Option<u64>,
    /// Nodes in the order of the plan.
    pub nodes: Vec<NodeProfile>,
    /// Every measured frame, with timers and without.
    pub frames: Vec<MeasuredFrame>,
    /// What was asked for and could not be measured, and why.
    pub not_measured: Vec<String>,
}

/// One node.
#[derive(Clone, Debug, Serialize)]
pub struct NodeProfile {
    /// Id in the graph file.
    pub node: String,
    /// Stage.
    pub stage: &'static str,
    /// Pass.
    pub pass: &'static str,
    /// Backend.
    pub on: Backend,
    /// Whose clock.
    pub clock: &'static str,
    /// Within whole frames.
    pub in_frame: Series,
    /// By itself.
    pub alone: Option<Series>,
    /// Whether the two disagree.
    pub disagrees: bool,
    /// Size of its outputs, bytes.
    pub bytes: usize,
    /// Size of its scratch memory and counters, bytes, where known; nodes share scratch memory.
    pub scratch_bytes: Option<u64>,
    /// Counts by name.
    pub counts: Vec<(&'static str, u64)>,
    /// How often its shaders ran, where that was counted.
    pub statistics: Option<NodeStatistics>,
}

/// One measured frame.
#[derive(Clone, Debug, Serialize)]
pub struct MeasuredFrame {
    /// Whether nodes were timed.
    pub timers: bool,
    /// When it began, milliseconds since the first measured frame, host clock.
    pub begin_millis: f64,
    /// How long it took, host clock: on wgpu submit to done, with the cost of timers.
    pub millis: f64,
    /// Each time a node ran and was timed: its index, and when, milliseconds since the frame began on the node's own clock.
    pub pieces: Vec<(usize, Reading)>,
}

/// Measures `plan` on `job`; `kept` is the same plan with every value kept, on which nodes run alone.
///
/// # Errors
/// As [`Machine::run`].
pub fn profile(
    machine: &Machine,
    plan: &Plan,
    kept: &Plan,
    job: &Job,
    settings: &Settings,
    progress: &Progress,
) -> Result<Profile, Problem> {
    let mut trial = Trial::new(machine, plan, job, &[], &Options::default(), progress)?;
    let measured = frames::measure(&mut trial, settings, progress)?;
    let mut not_measured = Vec::new();
    let mut alone = vec![None; plan.nodes.len()];
    if settings.timers && settings.alone > 0 {
        match alone::measure(machine, kept, job, settings.alone, progress)? {
            Ok(series) => alone = series.into_iter().map(Some).collect(),
            Err(why) => not_measured.push(format!("nodes alone: {why}")),
        }
    }
    let mut statistics = vec![None; plan.nodes.len()];
    if settings.statistics {
        match trial.ready().map(|ready| ready.statistics()).transpose()? {
            Some(Some(nodes)) => {
                let uncounted = plan.nodes.iter().zip(&nodes).filter(|(_, counted)| counted.is_none());
                let names: Vec<&str> = uncounted.map(|(node, _)| node.id.as_str()).collect();
                if !names.is_empty() {
                    let names = names.join(", ");
                    not_measured.push(format!("statistics of {names}: more passes than a query set holds"));
                }
                statistics = nodes;
            }
            Some(None) => not_measured.push("statistics: the device has no PIPELINE_STATISTICS_QUERY".into()),
            None => not_measured.push("statistics: not all nodes run on wgpu, whole".into()),
        }
    }
    let scratch = trial.ready().map(|ready| ready.scratch_bytes());
    let mut nodes = Vec::with_capacity(plan.nodes.len());
    for (index, (alone, statistics)) in alone.into_iter().zip(statistics).enumerate() {
        let of_frame = |frame: &MeasuredFrame| {
            let of_node = frame.pieces.iter().filter(|(node, _)| *node == index);
            of_node.map(|(_, reading)| *reading).collect()
        };
        let in_frame = Series::of(measured.timed().map(of_frame))?;
        let last = &measured.last.nodes[index];
        nodes.push(NodeProfile {
            node: last.node.clone(),
            stage: last.stage,
            pass: last.pass,
            on: last.on,
            clock: last.clock,
            disagrees: alone.as_ref().is_some_and(|alone| disagree(&in_frame, alone)),
            in_frame,
            alone,
            bytes: last.bytes,
            scratch_bytes: scratch.as_ref().map(|bytes| bytes[index]),
            counts: last.counts.clone(),
            statistics,
        });
    }
    Ok(Profile {
        warm_up_count: settings.warm_up,
        clocks: Clocks::of(machine, plan, settings, &measured, &nodes)?,
        frame: Times::of(&measured.millis(false))?,
        timed_frame: Times::of(&measured.millis(true))?,
        overlap: Overlap::of(measured.timed())?,
        memory_bytes: trial.ready().map(|ready| ready.memory_bytes()),
        nodes,
        frames: measured.frames,
        not_measured,
        cold: RunRecord::new(plan, job, machine.record(), trial.outcome()),
    })
}
