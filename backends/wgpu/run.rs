//! Frames of a session: upload, submit, wait, time, judge, read back.

use crate::counters::Verdict;
use crate::errors::scoped;
use crate::externals::Bound;
use crate::features::check_features;
use crate::prepare::{Prepared, Request};
use crate::readback::{read_part, read_words, wait};
use crate::session::{NodeRun, Options, Outcome, Session};
use crate::timing::{Clock, Stamps};
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Grown, Plan, SlotId};
use shadowgraph_core::problem::Problem;
use std::ops::Range;
use std::sync::PoisonError;
use std::time::Instant;

/// Uploads above this size are handed to the device at once.
const FLUSH_BYTES: usize = 32 << 20;

impl Session {
    /// Runs, and again while counters tell of an overflow and growing is allowed. Also returns what is wrong with the outcome.
    pub(crate) fn run_grown(
        &self,
        plan: &Plan,
        inputs: &[(SlotId, &Array)],
        image: [usize; 2],
        options: &Options,
    ) -> Result<(Outcome, Option<Problem>), Problem> {
        check_features(plan, self.device.features(), self.capabilities)?;
        let shapes: Vec<_> =
            inputs.iter().map(|(slot, array)| (plan.slots[*slot].name.clone(), array.shape().to_vec())).collect();
        let mut grown = Grown::new();
        for attempt in 0.. {
            let request = Request {
                grown: &grown,
                alias: options.alias,
                budget_bytes: options.budget_bytes,
                ..Request::new(plan, &shapes, image)
            };
            let prepared = Prepared::prepare_with(&self.pipelines, &self.device, &self.queue, &request)?;
            let done = scoped(&self.device, || self.frames(&prepared, inputs, options));
            self.check()?;
            let (mut outcome, verdict) = done?;
            if verdict.grown.is_empty() {
                outcome.arrays = scoped(&self.device, || self.kept(&prepared))?;
                outcome.grown = grown;
                return Ok((outcome, verdict.problem));
            }
            if let (Some(problem), true) = (verdict.problem, attempt >= options.regrow) {
                return Err(problem);
            }
            grown = verdict.grown;
        }
        unreachable!("the loop returns")
    }

    /// Uploads, runs all frames (the first alone when it overflows), and judges the counters.
    fn frames(
        &self,
        prepared: &Prepared,
        inputs: &[(SlotId, &Array)],
        options: &Options,
    ) -> Result<(Outcome, Verdict), Problem> {
        for (slot, array) in inputs {
            prepared.upload_any(&self.queue, *slot, array)?;
            // Written values are staged until a submission is done: large ones must not pile up.
            if array.bytes() > FLUSH_BYTES {
                wait(&self.device, Some(self.queue.submit([])))?;
            }
        }
        if options.poison {
            prepared.poison(&self.queue);
        }
        wait(&self.device, Some(self.queue.submit([])))?;
        let clock = match options.timers {
            true => Clock::fitting(self.kind, self.device.features()),
            false => Clock::Off,
        };
        let mut frames = Vec::new();
        let mut status = Vec::new();
        for frame in 0..options.warm_up + options.frames.max(1) {
            let times = self.frame(prepared, clock)?;
            if frame >= options.warm_up {
                frames.push(times);
            }
            status = self.status(prepared)?;
            if !prepared.judge(&status).grown.is_empty() {
                break;
            }
        }
        let verdict = prepared.judge(&status);
        let counts = prepared.counts(&status);
        let words = |slot: SlotId| prepared.layout.slot(slot).map_or(0, |part| part.bytes());
        let node_run = |(index, counts): (usize, Vec<u64>)| NodeRun {
            node: index,
            millis: median(frames.iter().filter_map(|times| times.nodes[index])),
            bytes: prepared.plan.nodes[index].outputs.iter().map(|(_, slot)| words(*slot)).sum(),
            scratch_bytes: prepared
                .layout
                .scratch(index)
                .iter()
                .chain(prepared.layout.counters(index))
                .map(|part| part.bytes())
                .sum(),
            counts,
        };
        let outcome = Outcome {
            arrays: Vec::new(),
            nodes: counts.into_iter().enumerate().map(node_run).collect(),
            frame_millis: median(frames.iter().map(|times| times.all)).unwrap_or_default(),
            clock,
            memory_bytes: prepared.bytes(),
            grown: Grown::new(),
        };
        Ok((outcome, verdict))
    }

    /// Runs one frame and waits for it.
    pub(crate) fn frame(&self, prepared: &Prepared, clock: Clock) -> Result<Times, Problem> {
        let bound = Bound::none(prepared);
        let count = prepared.nodes.len();
        let stamps = (clock == Clock::Device).then(|| Stamps::new(&self.device, count));
        let one = |nodes: Range<usize>| {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            prepared.record_nodes(&mut encoder, &bound, nodes, stamps.as_ref());
            if let Some(stamps) = &stamps {
                stamps.resolve(&mut encoder);
            }
            let commands = encoder.finish();
            let start = Instant::now();
            wait(&self.device, Some(self.queue.submit([commands])))?;
            Ok(start.elapsed().as_secs_f64() * 1e3)
        };
        if clock == Clock::HostPerNode {
            let nodes = (0..count).map(|node| one(node..node + 1).map(Some)).collect::<Result<Vec<_>, Problem>>()?;
            return Ok(Times { all: nodes.iter().flatten().sum(), nodes });
        }
        let all = one(0..count)?;
        let nodes = match &stamps {
            Some(stamps) => stamps.millis(prepared, &self.queue)?,
            None => vec![None; count],
        };
        Ok(Times { all, nodes })
    }

    fn status(&self, prepared: &Prepared) -> Result<Vec<u32>, Problem> {
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

    fn kept(&self, prepared: &Prepared) -> Result<Vec<(SlotId, Array)>, Problem> {
        let bound = Bound::none(prepared);
        let mut arrays = Vec::new();
        for (id, slot) in prepared.plan.slots.iter().enumerate() {
            if let (true, Some(part)) = (slot.keep, prepared.layout.slot(id)) {
                arrays.push((id, read_part(&bound, &self.queue, part, slot.element())?));
            }
        }
        Ok(arrays)
    }

    /// What the device reported outside every error scope.
    fn check(&self) -> Result<(), Problem> {
        let mut reports = self.reports.lock().unwrap_or_else(PoisonError::into_inner);
        if reports.is_empty() { Ok(()) } else { Err(reports.remove(0)) }
    }
}

/// Times of one frame, milliseconds.
pub(crate) struct Times {
    /// Submit to done, host clock.
    pub all: f64,
    /// By node of the plan.
    pub nodes: Vec<Option<f64>>,
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
