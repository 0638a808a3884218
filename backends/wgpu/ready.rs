//! Nodes that have run once and can run again, frame by frame: what paired timing is made of.

use crate::errors::scoped;
use crate::prepare::Prepared;
use crate::run::{Fitted, Times};
use crate::segment::Segment;
use crate::session::{Options, Session};
use crate::timing::Clock;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Grown, Plan, SlotId};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::reading::Reading;
use std::ops::Range;
use std::time::Instant;

/// Consecutive nodes of a plan with their memory, pipelines and inputs on the device.
#[derive(Debug)]
pub struct Ready<'s> {
    pub(crate) session: &'s Session,
    segment: Segment,
    nodes: Range<usize>,
    pub(crate) prepared: Prepared,
    first: Times,
}

/// One frame of a [`Ready`].
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Submit to done, host clock, milliseconds; with node timers on it includes their cost.
    pub millis: f64,
    /// Each node, in order.
    pub nodes: Vec<Reading>,
    /// Whose clock timed the nodes.
    pub clock: Clock,
}

impl Session {
    /// Makes the nodes `nodes` of `plan` ready, all on wgpu, and runs them once, grown until they fit; `value` gives what they read
    /// and do not make. Of `options`, the number of frames says nothing here.
    ///
    /// # Errors
    /// As [`Session::run_nodes`].
    pub fn ready<'a>(
        &self,
        plan: &Plan,
        nodes: Range<usize>,
        value: &dyn Fn(SlotId) -> Option<&'a Array>,
        image: [usize; 2],
        options: &Options,
    ) -> Result<Ready<'_>, Problem> {
        let segment = Segment::new(plan, nodes.clone());
        let inputs = segment.inputs(value)?;
        let Fitted { prepared, first, problem } =
            self.fit(&segment.plan, &inputs, image, options, &mut 0, &mut Grown::new())?;
        match problem {
            Some(problem) => Err(problem),
            None => Ok(Ready { session: self, segment, nodes, prepared, first }),
        }
    }
}

impl Ready<'_> {
    /// The nodes, by index into the whole plan.
    pub fn nodes(&self) -> Range<usize> {
        self.nodes.clone()
    }

    /// The frame that made it ready: pipelines and memory were new to the device.
    pub fn first(&self) -> Frame {
        self.of(self.first.clone())
    }

    /// Runs once more on the same inputs and waits.
    ///
    /// # Errors
    /// What the device reports; a list that fitted before and does not now.
    pub fn frame(&self, timers: bool) -> Result<Frame, Problem> {
        let clock = self.session.clock(timers);
        let times = scoped(&self.prepared.device, || self.session.frame(&self.prepared, clock))?;
        self.session.check()?;
        Ok(self.of(times))
    }

    /// Counts of each node's last run, in the order of its pass's counters.
    ///
    /// # Errors
    /// What the device reports; a count that had to be zero, or a list that did not fit.
    pub fn counts(&self) -> Result<Vec<Vec<u64>>, Problem> {
        let status = self.session.status(&self.prepared)?;
        match self.prepared.judge(&status).problem {
            Some(problem) => Err(problem),
            None => Ok(self.prepared.counts(&status)),
        }
    }

    /// Size of each node's outputs, bytes.
    pub fn bytes(&self) -> Vec<u64> {
        (0..self.prepared.plan.nodes.len()).map(|node| self.prepared.output_bytes(node)).collect()
    }

    /// Size of each node's scratch memory and counters, bytes; nodes share scratch memory.
    pub fn scratch_bytes(&self) -> Vec<u64> {
        (0..self.prepared.plan.nodes.len()).map(|node| self.prepared.scratch_bytes(node)).collect()
    }

    /// Device memory taken, bytes.
    pub fn memory_bytes(&self) -> u64 {
        self.prepared.bytes()
    }

    /// Uploads the values of inputs that `is_wanted`, by slot of the whole plan, once more, waits, and returns how long that took by
    /// the host's clock, milliseconds: memory and pipelines are ready by now, so it is the transfer alone.
    ///
    /// # Errors
    /// What the device reports; `value` has none for an input.
    pub fn upload_again<'a>(
        &self,
        value: &dyn Fn(SlotId) -> Option<&'a Array>,
        is_wanted: impl Fn(SlotId) -> bool,
    ) -> Result<f64, Problem> {
        let inputs = self.segment.inputs(value)?;
        let wanted: Vec<_> = inputs.into_iter().filter(|(slot, _)| is_wanted(self.segment.slots[*slot])).collect();
        if wanted.is_empty() {
            return Ok(0.0);
        }
        let begin = Instant::now();
        scoped(&self.prepared.device, || self.session.upload(&self.prepared, &wanted))?;
        Ok(begin.elapsed().as_secs_f64() * 1e3)
    }

    /// Values of kept slots, and of those that a node after these reads, by slot of the whole plan.
    ///
    /// # Errors
    /// What the device reports.
    pub fn arrays(&self) -> Result<Vec<(SlotId, Array)>, Problem> {
        self.arrays_of(|_| true)
    }

    /// As [`Ready::arrays`], of slots of the whole plan that `is_wanted`.
    ///
    /// # Errors
    /// What the device reports.
    pub fn arrays_of(&self, is_wanted: impl Fn(SlotId) -> bool) -> Result<Vec<(SlotId, Array)>, Problem> {
        let is_wanted = |slot: SlotId| is_wanted(self.segment.slots[slot]);
        let arrays = scoped(&self.prepared.device, || self.session.kept(&self.prepared, is_wanted))?;
        Ok(arrays.into_iter().map(|(slot, array)| (self.segment.slots[slot], array)).collect())
    }

    fn of(&self, times: Times) -> Frame {
        Frame { millis: times.all, nodes: times.nodes, clock: times.clock }
    }
}

impl Segment {
    /// What the nodes read and do not make, by slot of the segment's plan.
    ///
    /// # Errors
    /// `value` has none for one of them.
    pub(crate) fn inputs<'a>(
        &self,
        value: &dyn Fn(SlotId) -> Option<&'a Array>,
    ) -> Result<Vec<(SlotId, &'a Array)>, Problem> {
        let missing = |name: &str, expected: String| {
            Problem::new(Kind::Missing, "graph input is not supplied").port(name).expected(expected)
        };
        let found = |(inner, slot): (SlotId, &shadowgraph_core::plan::Slot)| {
            let array = value(self.slots[inner]).ok_or_else(|| missing(&slot.name, slot.port.type_text()))?;
            Ok((inner, array))
        };
        self.plan.inputs().map(found).collect()
    }
}
