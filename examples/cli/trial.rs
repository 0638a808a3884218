//! A plan on its inputs that runs again and again, frame by frame: what timings, profiles and checks are made of.

use crate::engine::{Given, Machine, supply};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::stretch::{Frame, How, ran};
use shadowgraph_core::plan::Plan;
use shadowgraph_core::problem::Problem;
use shadowgraph_cpu::{Progress, Store};
use shadowgraph_wgpu::{Options, Ready};

/// A plan that has run once.
///
/// On wgpu as a whole it keeps its memory and pipelines; with nodes on both backends, or view-samples in ranges, each stretch of
/// nodes is made ready anew in every frame and runs once untimed before it is timed.
pub struct Trial<'a> {
    machine: &'a Machine,
    plan: &'a Plan,
    job: &'a Job,
    given: &'a Given,
    options: Options,
    ready: Option<Ready<'static>>,
    outcome: Outcome,
}

impl<'a> Trial<'a> {
    /// Runs `plan` once: the warm-up.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn new(
        machine: &'a Machine,
        plan: &'a Plan,
        job: &'a Job,
        given: &'a Given,
        options: &Options,
        progress: &Progress,
    ) -> Result<Self, Problem> {
        let mut outcome = Outcome { runs_count: 1, ..Outcome::new(plan) };
        let mut ready = None;
        let (frame, values) = match machine.session_for(plan, job, given)?.filter(|_| !plan.nodes.is_empty()) {
            Some(session) => {
                let mut store = Store::new(plan);
                let mut inputs = job.inputs();
                inputs.extend(given.iter().cloned());
                supply(plan, &inputs, &mut store)?;
                let nodes = 0..plan.nodes.len();
                let made = session.ready(plan, nodes, &|slot| store.try_get(slot), job.image, options)?;
                let first = made.first();
                let mut frame = Frame::new(plan);
                frame.add(plan, first.millis, ran(&made, &[first])?);
                for (slot, array) in made.arrays()? {
                    store.put(slot, array);
                }
                ready = Some(made);
                (frame, store)
            }
            None => {
                let how = How { options: options.clone(), ..How::once(machine, job, progress) };
                machine.frame(plan, given, &how)?
            }
        };
        frame.record(plan, &mut outcome, true);
        outcome.values = values;
        Ok(Self { machine, plan, job, given, options: options.clone(), ready, outcome })
    }

    /// What the first run gave. Its times are those of a cold start.
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// The plan.
    pub fn plan(&self) -> &'a Plan {
        self.plan
    }

    /// The plan on its device, where it runs on wgpu as a whole.
    pub fn ready(&self) -> Option<&Ready<'static>> {
        self.ready.as_ref()
    }

    /// Runs once more. With `timers` off, nodes on wgpu are not timed one by one; those on the CPU always are, which costs nothing.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn frame(&mut self, timers: bool) -> Result<Frame, Problem> {
        let Some(ready) = &self.ready else {
            self.forget();
            let options = self.options.clone();
            let how = How { is_warmed_up: true, timers, options, ..How::once(self.machine, self.job, &|_, _, _| {}) };
            let (frame, values) = self.machine.frame(self.plan, self.given, &how)?;
            self.outcome.values = values;
            return Ok(frame);
        };
        let span = tracing::info_span!("frame", graph = self.plan.name, timers);
        let _entered = span.enter();
        let times = ready.frame(timers)?;
        let mut frame = Frame::new(self.plan);
        frame.add(self.plan, times.millis, ran(ready, &[times])?);
        Ok(frame)
    }

    /// Lets go of the values of the last frame on the CPU. Whoever times two trials by turns has both do so after each turn: else each
    /// runs in the memory that the other leaves free, one in pages it has used before, the other in fresh ones.
    pub fn forget(&mut self) {
        if self.ready.is_none() {
            self.outcome.values = Store::new(self.plan);
        }
    }

    /// The values of the last frame.
    ///
    /// # Errors
    /// What the device reports.
    pub fn values(&self) -> Result<Store, Problem> {
        let Some(ready) = &self.ready else { return Ok(self.outcome.values.clone()) };
        let mut store = self.outcome.values.clone();
        for (slot, array) in ready.arrays()? {
            store.put(slot, array);
        }
        Ok(store)
    }
}
