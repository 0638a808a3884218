//! Runs a plan whose nodes may be on both backends.

use crate::args::BackendChoice;
use crate::jitter;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::ranges::{self, Ranges};
use crate::record::DeviceRecord;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Grown, Plan};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_cpu::{Progress, Store};
use shadowgraph_wgpu::{Options, Session};
use std::ops::Range;
use std::time::Instant;

/// What nodes can run on.
pub struct Machine {
    session: Option<&'static Session>,
    /// Where nodes run that are not pinned.
    pub default_backend: Backend,
    /// Ranges of view-samples that run one after another; 0: as few as the device's bindings allow.
    pub ranges: usize,
    reason: String,
}

impl Machine {
    /// The machine a command asks for. `auto` takes a hardware adapter if there is one, else the CPU, and says so.
    ///
    /// # Errors
    /// `wgpu` without an adapter.
    pub fn new(choice: BackendChoice) -> Result<Self, Problem> {
        let cpu =
            |reason: &str| Self { session: None, default_backend: Backend::Cpu, ranges: 0, reason: reason.into() };
        match choice {
            BackendChoice::Cpu => Ok(cpu("asked for")),
            BackendChoice::Wgpu => Ok(Self {
                session: Some(Session::shared()?),
                default_backend: Backend::Wgpu,
                ranges: 0,
                reason: "asked for".into(),
            }),
            BackendChoice::Auto => match Session::shared() {
                Ok(session) if session.facts().device_type != "cpu" => Ok(Self {
                    session: Some(session),
                    default_backend: Backend::Wgpu,
                    ranges: 0,
                    reason: "a hardware adapter exists".into(),
                }),
                Ok(session) => Ok(cpu(&format!(
                    "the only adapter is a software one, {}; --backend wgpu uses it",
                    session.facts().name
                ))),
                Err(_) => Ok(cpu("no adapter exists")),
            },
        }
    }

    /// With so many ranges of view-samples, see [`Machine::ranges`].
    pub fn in_ranges(self, ranges: u32) -> Self {
        Self { ranges: ranges as usize, ..self }
    }

    /// Opens a session if `plan` has a node that needs one.
    ///
    /// # Errors
    /// No adapter exists.
    pub fn ready_for(&mut self, plan: &Plan) -> Result<(), Problem> {
        if self.session.is_none() && plan.nodes.iter().any(|node| node.on == Backend::Wgpu) {
            self.session = Some(Session::shared()?);
        }
        Ok(())
    }

    /// For the run's record.
    pub fn record(&self) -> DeviceRecord {
        let threads = rayon::current_num_threads();
        let none = || DeviceRecord {
            backend: "cpu",
            reason: self.reason.clone(),
            adapter: String::new(),
            driver: String::new(),
            adapter_type: String::new(),
            threads,
        };
        match &self.session {
            Some(session) => {
                let facts = session.facts();
                DeviceRecord {
                    backend: if self.default_backend == Backend::Wgpu { "wgpu" } else { "cpu" },
                    adapter: facts.name.clone(),
                    driver: format!("{} {}", facts.driver, facts.driver_info),
                    adapter_type: facts.device_type.into(),
                    ..none()
                }
            }
            None => none(),
        }
    }

    /// Runs `plan` on `job`: once, or `repeat` times after a warm-up. Where some nodes run on each backend, or view-samples in ranges,
    /// each stretch of nodes on wgpu is repeated by itself and CPU nodes run once.
    ///
    /// # Errors
    /// A node reports a problem, memory does not suffice, a value overflows its buffer past growing.
    pub fn run(&self, plan: &Plan, job: &Job, repeat: u32, progress: &Progress) -> Result<Outcome, Problem> {
        let inputs = job.inputs();
        let mut outcome = Outcome { runs_count: repeat, ..Outcome::new(plan) };
        let (rounds, warm_ups) = if shadowgraph_cpu::runs_all(plan) { (repeat, u32::from(repeat > 1)) } else { (1, 0) };
        let ranges = Ranges::of(plan, job.sets.len() > 1);
        let count = self.range_count(plan, &ranges, &inputs, job)?;
        let how = How { machine: self, job, repeat, progress };
        for round in 0..rounds + warm_ups {
            let mut store = Store::new(plan);
            supply(plan, &inputs, &mut store)?;
            let mut frame = Frame::new(plan);
            if count == 1 && job.sets.len() == 1 {
                for stretch in segments(plan) {
                    how.stretch(plan, stretch, &mut store, &mut frame)?;
                }
            } else {
                how.in_ranges(plan, &ranges, count, &mut store, &mut frame)?;
            }
            frame.record(plan, &mut outcome, round >= warm_ups);
            outcome.values = store;
        }
        Ok(outcome)
    }

    /// Ranges of view-samples, of each sample set where there are several, to run in.
    fn range_count(
        &self,
        plan: &Plan,
        ranges: &Ranges,
        inputs: &[(String, Array)],
        job: &Job,
    ) -> Result<usize, Problem> {
        let Some(session) = self.session.filter(|_| self.ranges == 0) else { return Ok(self.ranges.max(1)) };
        let of_set = job.set_inputs(0);
        let shape = |(name, array): &(String, Array)| {
            let array = of_set.iter().find(|(input, _)| input == name).map_or(array, |(_, array)| array);
            (name.clone(), array.shape().to_vec())
        };
        let shapes = plan.shapes(&inputs.iter().map(shape).collect::<Vec<_>>(), job.image, &Grown::new())?;
        let most_bytes = session.device().limits().max_storage_buffer_binding_size;
        // Every set has about as many pixels as another.
        Ok(ranges.needed(plan, &shapes, most_bytes.saturating_mul(job.sets.len() as u64)))
    }

    fn run_wgpu(&self, plan: &Plan, range: Range<usize>, image: [usize; 2], store: &mut Store, repeat: u32) -> Stretch {
        let Some(session) = &self.session else {
            return Err(Problem::new(Kind::Device, "a node is pinned to wgpu but there is no device")
                .remedy("use --backend wgpu"));
        };
        let options = Options { warm_up: u32::from(repeat > 1), frames: repeat, ..Options::default() };
        let ran = session.run_nodes(plan, range, &|slot| store.try_get(slot), image, &options)?;
        for (slot, array) in ran.arrays {
            store.put(slot, array);
        }
        let clock = ran.clock.text();
        let runs = ran.nodes.into_iter().map(|run| Ran {
            node: run.node,
            millis: run.millis,
            bytes: run.bytes as usize,
            clock,
            counts: run.counts,
        });
        Ok((ran.frame_millis, runs.collect()))
    }
}

/// What one node did: its time, or the median of its times.
struct Ran {
    node: usize,
    millis: Option<f64>,
    bytes: usize,
    clock: &'static str,
    counts: Vec<u64>,
}

/// How stretches of nodes run.
struct How<'a> {
    machine: &'a Machine,
    job: &'a Job,
    repeat: u32,
    progress: &'a Progress<'a>,
}

impl How<'_> {
    /// Neighbouring nodes on one backend.
    fn stretch(&self, plan: &Plan, nodes: Range<usize>, store: &mut Store, frame: &mut Frame) -> Result<(), Problem> {
        let (millis, runs) = match plan.nodes[nodes.start].on {
            Backend::Cpu => run_cpu(plan, nodes, self.job.image, store, self.progress)?,
            Backend::Wgpu => self.machine.run_wgpu(plan, nodes, self.job.image, store, self.repeat)?,
        };
        frame.add(millis, runs);
        Ok(())
    }

    /// Nodes that look at everything once, then the others over one part of the view-samples after another.
    fn in_ranges(
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
            for stretch in ranges.stretches(plan, true) {
                self.stretch(plan, stretch, &mut part, frame)?;
            }
            for (made, slot) in made.iter_mut().zip(&kept) {
                made.extend(part.take(*slot).map(|array| (array, rows.as_slice())));
            }
        }
        for (made, slot) in made.into_iter().zip(kept) {
            if let Some(array) = ranges::join(&plan.slots[slot].port, made) {
                store.put(slot, array);
            }
        }
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

/// One run of all nodes. A node that runs over several ranges has its times, bytes and counts added up.
struct Frame {
    millis: f64,
    nodes: Vec<Option<Ran>>,
}

impl Frame {
    fn new(plan: &Plan) -> Self {
        Self { millis: 0.0, nodes: plan.nodes.iter().map(|_| None).collect() }
    }

    fn add(&mut self, millis: f64, runs: Vec<Ran>) {
        self.millis += millis;
        for run in runs {
            let place = &mut self.nodes[run.node];
            *place = Some(match place.take() {
                None => run,
                Some(earlier) => Ran {
                    millis: earlier.millis.zip(run.millis).map(|(a, b)| a + b),
                    bytes: earlier.bytes + run.bytes,
                    counts: earlier.counts.iter().zip(&run.counts).map(|(a, b)| a + b).collect(),
                    ..run
                },
            });
        }
    }

    fn record(self, plan: &Plan, outcome: &mut Outcome, is_timed: bool) {
        for run in self.nodes.into_iter().flatten() {
            let record = &mut outcome.nodes[run.node];
            let counters = plan.nodes[run.node].pass.counters;
            (record.bytes, record.clock) = (run.bytes, run.clock);
            record.counts = counters.iter().map(|counter| counter.name).zip(run.counts).collect();
            if is_timed {
                record.millis.extend(run.millis);
            }
        }
        if is_timed {
            outcome.frames_millis.push(self.millis);
        }
    }
}

/// Milliseconds of the whole stretch of nodes, and its nodes.
type Stretch = Result<(f64, Vec<Ran>), Problem>;

fn run_cpu(plan: &Plan, range: Range<usize>, image: [usize; 2], store: &mut Store, progress: &Progress) -> Stretch {
    let start = Instant::now();
    let mut runs = Vec::new();
    for node in range {
        progress(&plan.nodes[node].id, 0, 1);
        let run = shadowgraph_cpu::run(plan, node, image, store, progress)?;
        runs.push(Ran {
            node,
            millis: Some(run.millis),
            bytes: run.bytes,
            clock: "host clock around the function",
            counts: run.counts,
        });
    }
    Ok((start.elapsed().as_secs_f64() * 1e3, runs))
}

/// Stretches of nodes on one backend.
fn segments(plan: &Plan) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for (index, node) in plan.nodes.iter().enumerate() {
        match ranges.last_mut() {
            Some(range) if plan.nodes[range.start].on == node.on => range.end = index + 1,
            _ => ranges.push(index..index + 1),
        }
    }
    ranges
}

/// Puts the graph's inputs in their slots.
fn supply(plan: &Plan, inputs: &[(String, Array)], store: &mut Store) -> Result<(), Problem> {
    for (id, slot) in plan.inputs() {
        let Some((_, array)) = inputs.iter().find(|(name, _)| *name == slot.name) else {
            return Err(Problem::new(Kind::Missing, "graph input is not supplied")
                .port(&slot.name)
                .expected(slot.port.type_text()));
        };
        store.put(id, array.clone());
    }
    Ok(())
}
