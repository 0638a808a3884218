//! Frames of a session: upload, submit, wait, time, judge, read back.

use crate::errors::scoped;
use crate::externals::Bound;
use crate::features::check_features;
use crate::prepare::{Prepared, Request};
use crate::readback::{read_part, read_words, wait};
use crate::record::Queries;
use crate::session::{NodeRun, Options, Outcome, Session};
use crate::timing::{Clock, Stamps};
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Grown, Plan, SlotId};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;
use std::ops::Range;
use std::sync::PoisonError;
use std::time::Instant;

/// Uploads above this size are handed to the device at once.
const FLUSH_BYTES: usize = 32 << 20;

/// A plan that has run once in memory large enough for it.
pub(crate) struct Fitted {
    pub prepared: Prepared,
    /// That run.
    pub first: Times,
    /// What is wrong with its outputs, other than what growing mends.
    pub problem: Option<Problem>,
}

impl Session {
    /// Runs, and again while counters tell of an overflow and growing is allowed. Also returns what is wrong with the outcome.
    pub(crate) fn run_grown(
        &self,
        plan: &Plan,
        inputs: &[(SlotId, &Array)],
        image: [usize; 2],
        options: &Options,
    ) -> Result<(Outcome, Option<Problem>), Problem> {
        let (mut attempts, mut grown) = (0, Grown::new());
        loop {
            let Fitted { prepared, first, .. } = self.fit(plan, inputs, image, options, &mut attempts, &mut grown)?;
            let clock = self.clock(options.timers);
            let mut frames = if options.warm_up == 0 { vec![first] } else { Vec::new() };
            // The run that fitted was the first of all.
            for _ in 1..options.warm_up {
                scoped(&self.device, || self.frame(&prepared, clock))?;
            }
            while frames.len() < options.frames.max(1) as usize {
                frames.push(scoped(&self.device, || self.frame(&prepared, clock))?);
            }
            let status = scoped(&self.device, || self.status(&prepared))?;
            self.check()?;
            let verdict = prepared.judge(&status);
            // Atomics may need a row more in a later frame.
            if verdict.grown.is_empty() || attempts >= options.regrow {
                let mut outcome = outcome(&prepared, &frames, &status, clock);
                outcome.arrays = scoped(&self.device, || self.kept(&prepared, |_| true))?;
                outcome.grown = grown;
                return Ok((outcome, verdict.problem));
            }
            grown = verdict.grown;
            attempts += 1;
        }
    }

    /// Prepares for capacities `grown`, uploads and runs once; with more memory as long as counters tell of an overflow and growing is
    /// allowed.
    pub(crate) fn fit(
        &self,
        plan: &Plan,
        inputs: &[(SlotId, &Array)],
        image: [usize; 2],
        options: &Options,
        attempts: &mut u32,
        grown: &mut Grown,
    ) -> Result<Fitted, Problem> {
        check_features(plan, self.device.features(), self.capabilities)?;
        let shapes: Vec<_> =
            inputs.iter().map(|(slot, array)| (plan.slots[*slot].name.clone(), array.shape().to_vec())).collect();
        loop {
            let request = Request {
                grown,
                alias: options.alias,
                budget_bytes: options.budget_bytes,
                ..Request::new(plan, &shapes, image)
            };
            let prepared = Prepared::prepare_with(&self.pipelines, &self.device, &self.queue, &request)?;
            let done = scoped(&self.device, || self.first_frame(&prepared, inputs, options));
            self.check()?;
            let (first, status) = done?;
            let verdict = prepared.judge(&status);
            if verdict.grown.is_empty() {
                return Ok(Fitted { prepared, first, problem: verdict.problem });
            }
            if let (Some(problem), true) = (verdict.problem, *attempts >= options.regrow) {
                return Err(problem);
            }
            *grown = verdict.grown;
            *attempts += 1;
        }
    }

    /// Uploads and runs one frame; its times and the counters after it.
    fn first_frame(
        &self,
        prepared: &Prepared,
        inputs: &[(SlotId, &Array)],
        options: &Options,
    ) -> Result<(Times, Vec<u32>), Problem> {
        self.upload(prepared, inputs)?;
        if options.poison {
            prepared.poison(&self.queue);
        }
        wait(&self.device, Some(self.queue.submit([])))?;
        Ok((self.frame(prepared, self.clock(options.timers))?, self.status(prepared)?))
    }

    /// Writes the values of inputs, and waits until they are there.
    pub(crate) fn upload(&self, prepared: &Prepared, inputs: &[(SlotId, &Array)]) -> Result<(), Problem> {
        for (slot, array) in inputs {
            prepared.upload_any(&self.queue, *slot, array)?;
            // Written values are staged until a submission is done: large ones must not pile up.
            if array.bytes() > FLUSH_BYTES {
                wait(&self.device, Some(self.queue.submit([])))?;
            }
        }
        wait(&self.device, Some(self.queue.submit([])))
    }

    /// Whose clock times nodes here, if timers are on.
    pub(crate) fn clock(&self, timers: bool) -> Clock {
        if timers { Clock::fitting(self.kind, self.device.features()) } else { Clock::Off }
    }

    /// Runs one frame and waits for it.
    pub(crate) fn frame(&self, prepared: &Prepared, clock: Clock) -> Result<Times, Problem> {
        let bound = Bound::none(prepared);
        let count = prepared.nodes.len();
        let span = tracing::info_span!("stretch", graph = prepared.plan.name, nodes = count, clock = clock.text());
        let _entered = span.enter();
        let stamps = (clock == Clock::Device).then(|| Stamps::new(&self.device, count));
        let mut from = None;
        // Milliseconds since the first submission, at submit and when done.
        let mut one = |nodes: Range<usize>| {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            let queries = Queries { stamps: stamps.as_ref(), ..Queries::default() };
            prepared.record_nodes(&mut encoder, &bound, nodes, queries);
            if let Some(stamps) = &stamps {
                stamps.resolve(&mut encoder);
            }
            let commands = encoder.finish();
            let from = *from.get_or_insert_with(Instant::now);
            let begin = from.elapsed().as_secs_f64() * 1e3;
            wait(&self.device, Some(self.queue.submit([commands])))?;
            Ok([begin, from.elapsed().as_secs_f64() * 1e3])
        };
        if clock == Clock::HostPerNode {
            let mut timed = |index: usize| {
                let node = &prepared.plan.nodes[index];
                let span = tracing::info_span!("node", id = node.id, pass = node.pass.name);
                span.in_scope(|| one(index..index + 1))
            };
            let spans = (0..count).map(&mut timed).collect::<Result<Vec<_>, Problem>>()?;
            // Recording and submitting between nodes is what these timers cost.
            let all = spans.first().zip(spans.last()).map_or(0.0, |([begin, _], [_, end])| end - begin);
            let nodes = spans.into_iter().map(|[begin, end]| Reading::of(begin, end)).collect();
            return Ok(Times { all, nodes, clock });
        }
        let [begin, end] = one(0..count)?;
        let nodes = match &stamps {
            Some(stamps) => stamps.readings(prepared, &self.queue)?,
            None => vec![Reading::Untimed; count],
        };
        // On a device's own clock a node is no span of this thread: an event says when it ran.
        for (node, reading) in prepared.plan.nodes.iter().zip(&nodes).filter(|_| stamps.is_some()) {
            tracing::info!(id = node.id, pass = node.pass.name, ?reading, "node");
        }
        Ok(Times { all: end - begin, nodes, clock })
    }

    pub(crate) fn status(&self, prepared: &Prepared) -> Result<Vec<u32>, Problem> {
        let count = prepared.status_words();
        if count == 0 {
            return Ok(Vec::new());
        }
        let status = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("status"),
            size: count as u64 * 4,
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        prepared.record_status(&mut encoder, &status);
        self.queue.submit([encoder.finish()]);
        read_words(&self.device, &self.queue, &status, 0, count)
    }

    pub(crate) fn kept(
        &self,
        prepared: &Prepared,
        is_wanted: impl Fn(SlotId) -> bool,
    ) -> Result<Vec<(SlotId, Array)>, Problem> {
        let bound = Bound::none(prepared);
        let mut arrays = Vec::new();
        for (id, slot) in prepared.plan.slots.iter().enumerate() {
            if let (true, Some(part)) = (slot.keep && is_wanted(id), prepared.layout.slot(id)) {
                arrays.push((id, read_part(&bound, &self.queue, part, slot.element())?));
            }
        }
        Ok(arrays)
    }

    /// What the device reported outside every error scope.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        let mut reports = self.reports.lock().unwrap_or_else(PoisonError::into_inner);
        if reports.is_empty() { Ok(()) } else { Err(reports.remove(0)) }
    }
}

impl Prepared {
    /// Size of a node's outputs, bytes.
    pub(crate) fn output_bytes(&self, node: usize) -> u64 {
        let bytes = |slot: SlotId| self.layout.slot(slot).map_or(0, |part| part.bytes());
        self.plan.nodes[node].outputs.iter().map(|(_, slot)| bytes(*slot)).sum()
    }

    pub(crate) fn scratch_bytes(&self, node: usize) -> u64 {
        self.layout.scratch(node).iter().chain(self.layout.counters(node)).map(|part| part.bytes()).sum()
    }
}

fn outcome(prepared: &Prepared, frames: &[Times], status: &[u32], clock: Clock) -> Outcome {
    let node_run = |(node, counts): (usize, Vec<u64>)| NodeRun {
        node,
        millis: median(frames.iter().filter_map(|times| times.nodes[node].millis())),
        bytes: prepared.output_bytes(node),
        scratch_bytes: prepared.scratch_bytes(node),
        counts,
    };
    Outcome {
        arrays: Vec::new(),
        nodes: prepared.counts(status).into_iter().enumerate().map(node_run).collect(),
        frame_millis: median(frames.iter().map(|times| times.all)).unwrap_or_default(),
        clock,
        memory_bytes: prepared.bytes(),
        grown: Grown::new(),
    }
}

/// Times of one frame.
#[derive(Clone, Debug)]
pub(crate) struct Times {
    /// First submission to all done, host clock, milliseconds.
    pub all: f64,
    /// By node of the plan.
    pub nodes: Vec<Reading>,
    pub clock: Clock,
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => None,
        count if count % 2 == 1 => Some(values[middle]),
        _ => Some((values[middle - 1] + values[middle]) / 2.0),
    }
}
