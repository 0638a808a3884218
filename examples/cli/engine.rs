//! Runs a plan whose nodes may be on both backends.

use crate::args::BackendChoice;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::ranges::Ranges;
use crate::record::DeviceRecord;
use crate::stretch::{Frame, How};
use crate::trial::Trial;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Grown, Plan};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_cpu::{Progress, Store};
use shadowgraph_wgpu::{Options, Session};
use std::ops::Range;

/// Values of slots by name, beside the job's.
pub type Given = [(String, Array)];

/// What nodes can run on.
#[derive(Clone)]
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

    /// With a device, for nodes that are pinned to it later.
    pub fn open(&mut self, session: &'static Session) {
        self.session = Some(session);
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
    /// each stretch of nodes on wgpu is repeated by itself and CPU nodes run once: then there is one time, a median.
    ///
    /// # Errors
    /// A node reports a problem, memory does not suffice, a value overflows its buffer past growing.
    pub fn run(&self, plan: &Plan, job: &Job, repeat: u32, progress: &Progress) -> Result<Outcome, Problem> {
        self.run_given(plan, job, &[], repeat, progress)
    }

    /// As [`Machine::run`], with the values of some slots by name: for plans that [`Plan::given`] cut.
    ///
    /// # Errors
    /// As [`Machine::run`]; a given value that is missing.
    pub fn run_given(
        &self,
        plan: &Plan,
        job: &Job,
        given: &Given,
        repeat: u32,
        progress: &Progress,
    ) -> Result<Outcome, Problem> {
        let mut outcome = Outcome { runs_count: repeat, ..Outcome::new(plan) };
        if repeat > 1 && self.session_for(plan, job, given)?.is_some() {
            let mut trial = Trial::new(self, plan, job, given, &Options::default(), progress)?;
            for _ in 0..repeat {
                trial.frame(true)?.record(plan, &mut outcome, true);
            }
            outcome.values = trial.values()?;
            return Ok(outcome);
        }
        let (rounds, warm_ups) = if shadowgraph_cpu::runs_all(plan) { (repeat, u32::from(repeat > 1)) } else { (1, 0) };
        let how = How { repeat, is_warmed_up: repeat > 1, ..How::once(self, job, progress) };
        for round in 0..rounds + warm_ups {
            let (frame, values) = self.frame(plan, given, &how)?;
            frame.record(plan, &mut outcome, round >= warm_ups);
            outcome.values = values;
        }
        Ok(outcome)
    }

    /// One run of all nodes: what they did, and the values that are kept.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn frame(&self, plan: &Plan, given: &Given, how: &How) -> Result<(Frame, Store), Problem> {
        let mut inputs = how.job.inputs();
        inputs.extend(given.iter().cloned());
        let ranges = Ranges::of(plan, how.job.sets.len() > 1);
        let count = self.range_count(plan, &ranges, &inputs, how.job)?;
        let mut store = Store::new(plan);
        supply(plan, &inputs, &mut store)?;
        let span = tracing::info_span!("frame", graph = plan.name, ranges = count);
        let _entered = span.enter();
        let mut frame = Frame::new(plan);
        if count == 1 && how.job.sets.len() == 1 {
            for stretch in segments(plan) {
                how.stretch(plan, stretch, &mut store, &mut frame)?;
            }
        } else {
            how.in_ranges(plan, &ranges, count, &mut store, &mut frame)?;
        }
        Ok((frame, store))
    }

    /// The session, if `plan` runs on it as a whole and in one piece on `job`.
    ///
    /// # Errors
    /// A graph input is missing.
    pub fn session_for(&self, plan: &Plan, job: &Job, given: &Given) -> Result<Option<&'static Session>, Problem> {
        let mut inputs = job.inputs();
        inputs.extend(given.iter().cloned());
        let is_whole = job.sets.len() == 1 && plan.nodes.iter().all(|node| node.on == Backend::Wgpu);
        let Some(session) = self.session.filter(|_| is_whole) else { return Ok(None) };
        let count = self.range_count(plan, &Ranges::of(plan, false), &inputs, job)?;
        Ok((count == 1).then_some(session))
    }

    /// How many parts of the view-samples `plan` runs over on `job`, one after another.
    ///
    /// # Errors
    /// A graph input is missing.
    pub fn parts_count(&self, plan: &Plan, job: &Job) -> Result<usize, Problem> {
        let ranges = Ranges::of(plan, job.sets.len() > 1);
        Ok(job.sets.len() * self.range_count(plan, &ranges, &job.inputs(), job)?)
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

    /// The device that wgpu nodes run on.
    ///
    /// # Errors
    /// There is none.
    pub fn session(&self) -> Result<&'static Session, Problem> {
        self.session.ok_or_else(|| {
            Problem::new(Kind::Device, "a node is pinned to wgpu but there is no device").remedy("use --backend wgpu")
        })
    }
}

/// Stretches of nodes on one backend.
pub fn segments(plan: &Plan) -> Vec<Range<usize>> {
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
pub fn supply(plan: &Plan, inputs: &[(String, Array)], store: &mut Store) -> Result<(), Problem> {
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
