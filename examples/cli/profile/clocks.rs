//! Whose clocks timed what, how far they can be trusted, and what they cost.

use super::frames::Measured;
use super::times::{Readings, Times};
use super::{NodeProfile, Settings};
use crate::engine::Machine;
use serde::Serialize;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::problem::Problem;
use shadowgraph_measure::statistics::{Interval, order_interval};
use std::hint::black_box;
use std::time::Instant;

/// Whose clocks, and how far they can be trusted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Clocks {
    /// Whether nodes were timed.
    pub timers: bool,
    /// Clocks of the nodes, without repetition.
    pub node_clocks: Vec<&'static str>,
    /// Whether the device has timestamps; none where no node runs on one.
    pub has_timestamps: Option<bool>,
    /// Whether the adapter is a program on the CPU: its times say little about a GPU, and its timestamps nothing.
    pub is_software_rasteriser: bool,
    /// All readings in frames.
    pub in_frame: Readings,
    /// All readings of nodes alone.
    pub alone: Readings,
    /// What timers cost; none where they were off, or there were too few frames.
    pub cost: Option<TimerCost>,
}

/// What the timers of a frame cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimerCost {
    /// Median, milliseconds a frame.
    pub millis: f64,
    /// Interval of that median at 95 %, where there are enough frames.
    pub interval: Option<Interval>,
    /// The same as a share of a frame.
    pub share: f64,
    /// How it was found.
    pub how: &'static str,
}

/// Confidence of the interval of the timers' cost.
const CONFIDENCE: f64 = 0.95;

impl Clocks {
    pub(super) fn of(
        machine: &Machine,
        plan: &Plan,
        settings: &Settings,
        measured: &Measured,
        nodes: &[NodeProfile],
    ) -> Result<Self, Problem> {
        let has_device = plan.nodes.iter().any(|node| node.on == Backend::Wgpu);
        let session = machine.session().ok().filter(|_| has_device);
        let (mut in_frame, mut alone) = (Readings::default(), Readings::default());
        let mut node_clocks = Vec::new();
        for node in nodes {
            in_frame.extend(node.in_frame.readings);
            node.alone.iter().for_each(|series| alone.extend(series.readings));
            if !node_clocks.contains(&node.clock) {
                node_clocks.push(node.clock);
            }
        }
        let cost = match (settings.timers, has_device) {
            (false, _) => None,
            (true, true) => paired_cost(measured)?,
            (true, false) => clock_cost(measured, plan.nodes.len())?,
        };
        Ok(Self {
            timers: settings.timers,
            node_clocks: if settings.timers { node_clocks } else { Vec::new() },
            has_timestamps: session.map(|session| session.has_timestamps()),
            is_software_rasteriser: session.is_some_and(|session| session.facts().device_type == "cpu"),
            in_frame,
            alone,
            cost,
        })
    }
}

/// Each timed frame against the untimed one beside it.
fn paired_cost(measured: &Measured) -> Result<Option<TimerCost>, Problem> {
    let (timed, untimed) = (measured.millis(true), measured.millis(false));
    let differences: Vec<f64> = timed.iter().zip(&untimed).map(|(timed, untimed)| timed - untimed).collect();
    let (Some(cost), Some(frame)) = (Times::of(&differences)?, Times::of(&untimed)?) else {
        return Ok(None);
    };
    Ok(Some(TimerCost {
        millis: cost.median,
        interval: order_interval(&differences, CONFIDENCE)?,
        share: cost.median / frame.median.max(f64::MIN_POSITIVE),
        how: "whole frames with timers on and off, in turn: median of the paired differences",
    }))
}

/// Two clock reads a node.
fn clock_cost(measured: &Measured, nodes: usize) -> Result<Option<TimerCost>, Problem> {
    const READS: usize = 10_000;
    let from = Instant::now();
    for _ in 0..READS {
        black_box(Instant::now());
    }
    let millis = from.elapsed().as_secs_f64() * 1e3 / READS as f64 * 2.0 * nodes as f64;
    let frame =
        Times::of(&measured.millis(true))?.map_or(f64::MIN_POSITIVE, |times| times.median.max(f64::MIN_POSITIVE));
    let how = "two reads of the host's clock a node, timed by themselves";
    Ok(Some(TimerCost { millis, interval: None, share: millis / frame, how }))
}
