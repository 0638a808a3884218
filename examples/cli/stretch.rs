//! Stretches of nodes on one backend, whole or over one range of view-samples after another.

use crate::engine::Machine;
use crate::jitter;
use crate::job::Job;
use crate::outcome::{Outcome, Spread};
use crate::ranges::{self, Ranges};
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::CounterKind;
use shadowgraph_core::plan::{Backend, Plan, Producer, SlotId};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;
use shadowgraph_cpu::{Progress, Store};
use shadowgraph_wgpu::{Options, Ready};
use std::ops::Range;
use std::time::Instant;

/// What one node did.
pub struct Ran {
    /// Index into the plan's nodes.
    pub node: usize,
    /// Its time, or the median of its times; milliseconds.
    pub millis: Option<f64>,
    /// When it last ran, milliseconds since its stretch began.
    pub reading: Reading,
    /// Size of its outputs.
    pub bytes: usize,
    /// Whose clock.
    pub clock: &'static str,
    /// Counts in the order of its pass's counters.
    pub counts: Vec<u64>,
}

impl Ran {
    /// Its time, where one was read: nothing at all where its clock says so, which none of its times tells.
    pub fn known_millis(&self) -> Option<f64> {
        self.millis.or((self.reading == Reading::Zero).then_some(0.0))
    }
}

/// How stretches of nodes run.
pub struct How<'a> {
    /// On what.
    pub machine: &'a Machine,
    /// On which inputs.
    pub job: &'a Job,
    /// Timed runs of each stretch on wgpu.
    pub repeat: u32,
    /// Whether each stretch on wgpu runs once untimed first.
    pub is_warmed_up: bool,
    /// Whether nodes on wgpu are timed, which costs.
    pub timers: bool,
    /// How memory on wgpu is used; what it says of frames and timers does not count.
    pub options: Options,
    /// Told what is done.
    pub progress: &'a Progress<'a>,
}

impl<'a> How<'a> {
    /// Every node once, timed, without a warm-up.
    pub fn once(machine: &'a Machine, job: &'a Job, progress: &'a Progress<'a>) -> Self {
        Self { machine, job, repeat: 1, is_warmed_up: false, timers: true, options: Options::default(), progress }
    }

    /// Neighbouring nodes on one backend.
    pub fn stretch(
        &self,
        plan: &Plan,
        nodes: Range<usize>,
        store: &mut Store,
        frame: &mut Frame,
    ) -> Result<(), Problem> {
        match plan.nodes[nodes.start].on {
            Backend::Cpu => {
                let (millis, runs) = run_cpu(plan, nodes, self.job.image, store, self.progress)?;
                frame.add(plan, millis, runs);
                Ok(())
            }
            Backend::Wgpu => self.run_wgpu(plan, nodes, store, frame),
        }
    }

    /// Transfers count as lying between stretches: up, of what nodes before these made, and down, of what nodes after them read.
    fn run_wgpu(&self, plan: &Plan, nodes: Range<usize>, store: &mut Store, frame: &mut Frame) -> Result<(), Problem> {
        let options = Options { timers: self.timers, ..self.options.clone() };
        let session = self.machine.session()?;
        let later = &plan.nodes[nodes.end..];
        let is_read_later = |slot: SlotId| later.iter().any(|node| node.inputs.iter().any(|(_, read)| *read == slot));
        let is_made = |slot: SlotId| matches!(plan.slots[slot].producer, Producer::Node(_));
        let ready = session.ready(plan, nodes, &|slot| store.try_get(slot), self.job.image, &options)?;
        let frames = match self.is_warmed_up {
            true => (0..self.repeat).map(|_| ready.frame(self.timers)).collect::<Result<_, _>>()?,
            false => vec![ready.first()],
        };
        let runs = ran(&ready, &frames)?;
        frame.between(ready.upload_again(&|slot| store.try_get(slot), is_made)?);
        let millis: Vec<f64> = frames.iter().map(|frame| frame.millis).collect();
        frame.add(plan, Spread::of(&millis).median, runs);
        let begin = Instant::now();
        let read_later = ready.arrays_of(is_read_later)?;
        if !read_later.is_empty() {
            frame.between(begin.elapsed().as_secs_f64() * 1e3);
        }
        for (slot, array) in read_later.into_iter().chain(ready.arrays_of(|slot| !is_read_later(slot))?) {
            store.put(slot, array);
        }
        Ok(())
    }

    /// Nodes that look at everything once, then the others over one part of the view-samples after another.
    pub fn in_ranges(
        &self,
        plan: &Plan,
        ranges: &Ranges,
        count: usize,
        store: &mut Store,
        frame: &mut Frame,
    ) -> Result<(), Problem> {
        let (taken, kept) = (ranges.taken(plan), ranges.kept(plan));
        let pixels = plan.slots.iter().position(|slot| slot.port.quantity == PIXEL);
        let mut whole = plan.clone();
        for slot in taken.iter().chain(&pixels) {
            whole.slots[*slot].keep = true;
        }
        for stretch in ranges.stretches(plan, false) {
            self.stretch(&whole, stretch, store, frame)?;
        }
        let parts = self.parts(&taken, pixels, plan, store, count);
        let mut made: Vec<Vec<(Array, &[usize])>> = vec![Vec::new(); kept.len()];
        for (set, rows) in &parts {
            let begin = Instant::now();
            let of_set = self.job.set_inputs(*set);
            let mut part = Store::new(plan);
            for slot in &taken {
                let name = &plan.slots[*slot].name;
                let array = match of_set.iter().find(|(input, _)| input == name) {
                    Some((_, array)) => array.clone(),
                    None if ranges::is_rows(&plan.slots[*slot].port) => ranges::gather(store.get(*slot), rows),
                    None => store.get(*slot).clone(),
                };
                part.put(*slot, array);
            }
            frame.between(begin.elapsed().as_secs_f64() * 1e3);
            for stretch in ranges.stretches(plan, true) {
                self.stretch(plan, stretch, &mut part, frame)?;
            }
            for (made, slot) in made.iter_mut().zip(&kept) {
                made.extend(part.take(*slot).map(|array| (array, rows.as_slice())));
            }
        }
        let begin = Instant::now();
        for (made, slot) in made.into_iter().zip(kept) {
            if let Some(array) = ranges::join(&plan.slots[slot].port, made) {
                store.put(slot, array);
            }
        }
        frame.between(begin.elapsed().as_secs_f64() * 1e3);
        Ok(())
    }

    /// Sample set and rows of each part.
    fn parts(
        &self,
        taken: &[usize],
        pixels: Option<usize>,
        plan: &Plan,
        store: &Store,
        count: usize,
    ) -> Vec<(usize, Vec<usize>)> {
        let mut by_set = Vec::new();
        match pixels.and_then(|slot| store.try_get(slot)).filter(|_| self.job.sets.len() > 1) {
            Some(pixels) => {
                let set_of = |column, row| jitter::set_of(column, row, self.job.jitter_side);
                by_set = ranges::by_set(pixels.as_u32(), self.job.image[0], set_of, self.job.sets.len());
            }
            None => {
                let rows = taken.iter().find(|slot| ranges::is_rows(&plan.slots[**slot].port));
                by_set.push((0..rows.map_or(0, |slot| store.get(*slot).dim(0))).collect());
            }
        }
        let cut = |(set, rows): (usize, Vec<usize>)| {
            let ranges = ranges::split(rows.len(), count).into_iter();
            ranges.map(move |range| (set, rows[range].to_vec())).collect::<Vec<_>>()
        };
        by_set.into_iter().enumerate().flat_map(cut).collect()
    }
}

/// Quantity of the port that says which pixel a view-sample is seen through.
const PIXEL: &str = "pixel";

/// One run of all nodes.
pub struct Frame {
    /// All stretches together, and the transfers, gathering and joining between them; without making memory and pipelines ready, and
    /// without what a run as a whole leaves out too: uploads of the graph's inputs, reading back what no later node reads.
    pub millis: f64,
    /// Of these, what lies between stretches, by the host's clock: values made by nodes that go up or down, rows gathered and joined.
    pub between_millis: f64,
    /// By node. One that runs over several ranges has its times, bytes and counts added up; of largest counts it has the largest.
    pub nodes: Vec<Option<Ran>>,
    /// Each time a node ran: its index, and when, milliseconds of [`Frame::millis`] since its begin.
    pub pieces: Vec<(usize, Reading)>,
}

impl Frame {
    /// Nothing has run.
    pub fn new(plan: &Plan) -> Self {
        Self { millis: 0.0, between_millis: 0.0, nodes: plan.nodes.iter().map(|_| None).collect(), pieces: Vec::new() }
    }

    /// Takes in time spent between stretches.
    pub fn between(&mut self, millis: f64) {
        self.millis += millis;
        self.between_millis += millis;
    }

    /// Takes a stretch in.
    pub fn add(&mut self, plan: &Plan, millis: f64, runs: Vec<Ran>) {
        // The readings of nodes with a submission each reach past the sum of their times, by what lies between them.
        let end = |reading: &Reading| if let Reading::Span { end, .. } = reading { *end } else { 0.0 };
        let from = self.pieces.iter().map(|(_, reading)| end(reading)).fold(self.millis, f64::max);
        self.millis += millis;
        for run in runs {
            self.pieces.push((run.node, run.reading.later(from)));
            let place = &mut self.nodes[run.node];
            *place = Some(match place.take() {
                None => run,
                Some(earlier) => Ran {
                    millis: earlier.millis.zip(run.millis).map(|(a, b)| a + b),
                    bytes: earlier.bytes + run.bytes,
                    counts: {
                        let counters = plan.nodes[run.node].pass.counters.iter();
                        let both = earlier.counts.iter().zip(&run.counts);
                        counters.zip(both).map(|(counter, (a, b))| counter.kind.joined(*a, *b)).collect()
                    },
                    ..run
                },
            });
        }
    }

    /// Adds to a record of runs.
    pub fn record(self, plan: &Plan, outcome: &mut Outcome, is_timed: bool) {
        for run in self.nodes.into_iter().flatten() {
            let record = &mut outcome.nodes[run.node];
            let counters = plan.nodes[run.node].pass.counters;
            (record.bytes, record.clock) = (run.bytes, run.clock);
            let is_kept = |kind| kind != CounterKind::OnCpu || plan.nodes[run.node].on == Backend::Cpu;
            let counted = counters.iter().zip(run.counts).filter(|(counter, _)| is_kept(counter.kind));
            record.counts = counted.map(|(counter, count)| (counter.name, count)).collect();
            if is_timed {
                record.millis.extend(run.millis);
            }
        }
        if is_timed {
            outcome.frames_millis.push(self.millis);
        }
    }
}

/// What the nodes of a stretch on wgpu did in some frames.
///
/// # Errors
/// What the device reports; a count that had to be zero.
pub fn ran(ready: &Ready, frames: &[shadowgraph_wgpu::ready::Frame]) -> Result<Vec<Ran>, Problem> {
    let (counts, bytes) = (ready.counts()?, ready.bytes());
    let clock = frames.last().map_or("", |frame| frame.clock.text());
    let one = |(index, counts): (usize, Vec<u64>)| {
        let times: Vec<f64> = frames.iter().filter_map(|frame| frame.nodes[index].millis()).collect();
        Ran {
            node: ready.nodes().start + index,
            millis: (!times.is_empty()).then(|| Spread::of(&times).median),
            reading: frames.last().map_or(Reading::Untimed, |frame| frame.nodes[index]),
            bytes: bytes[index] as usize,
            clock,
            counts,
        }
    };
    Ok(counts.into_iter().enumerate().map(one).collect())
}

/// Milliseconds of the whole stretch of nodes, and its nodes.
type Stretch = Result<(f64, Vec<Ran>), Problem>;

fn run_cpu(plan: &Plan, range: Range<usize>, image: [usize; 2], store: &mut Store, progress: &Progress) -> Stretch {
    let start = Instant::now();
    let mut runs = Vec::new();
    for node in range {
        progress(&plan.nodes[node].id, 0, 1);
        let begin = start.elapsed().as_secs_f64() * 1e3;
        let run = shadowgraph_cpu::run(plan, node, image, store, progress)?;
        runs.push(Ran {
            node,
            millis: Some(run.millis),
            reading: Reading::of(begin, begin + run.millis),
            bytes: run.bytes,
            clock: "host clock around the function",
            counts: run.counts,
        });
    }
    Ok((start.elapsed().as_secs_f64() * 1e3, runs))
}
