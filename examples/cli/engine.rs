//! Runs a plan whose nodes may be on both backends.

use crate::args::{BackendChoice, RunChoice};
use crate::job::Job;
use crate::outcome::{NodeRecord, Outcome};
use crate::record::DeviceRecord;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan, Producer};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_cpu::{Progress, Store};
use shadowgraph_wgpu::segment::Segment;
use shadowgraph_wgpu::{Options, Session};
use std::ops::Range;
use std::time::Instant;

/// What nodes can run on.
pub struct Machine {
    session: Option<Session>,
    /// Where nodes run that are not pinned.
    pub default_backend: Backend,
    reason: String,
}

impl Machine {
    /// The machine a command asks for. `auto` takes a hardware adapter if there is one, else the CPU, and says so.
    ///
    /// # Errors
    /// `wgpu` without an adapter.
    pub fn new(choice: BackendChoice) -> Result<Self, Problem> {
        let cpu = |reason: &str| Self { session: None, default_backend: Backend::Cpu, reason: reason.into() };
        match choice {
            BackendChoice::Cpu => Ok(cpu("asked for")),
            BackendChoice::Wgpu => {
                Ok(Self { session: Some(Session::new(None)?), default_backend: Backend::Wgpu, reason: "asked for".into() })
            }
            BackendChoice::Auto => match Session::new(None) {
                Ok(session) if !session.is_software() => {
                    Ok(Self { session: Some(session), default_backend: Backend::Wgpu, reason: "a hardware adapter exists".into() })
                }
                Ok(session) => Ok(cpu(&format!(
                    "the only adapter is a software one, {}; --backend wgpu uses it",
                    session.adapter().name
                ))),
                Err(_) => Ok(cpu("no adapter exists")),
            },
        }
    }

    /// Opens a session if `plan` has a node that needs one.
    ///
    /// # Errors
    /// No adapter exists.
    pub fn ready_for(&mut self, plan: &Plan) -> Result<(), Problem> {
        if self.session.is_none() && plan.nodes.iter().any(|node| node.on == Backend::Wgpu) {
            self.session = Some(Session::new(None)?);
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
                let facts = session.adapter();
                DeviceRecord {
                    backend: if self.default_backend == Backend::Wgpu { "wgpu" } else { "cpu" },
                    adapter: facts.name.clone(),
                    driver: facts.driver.clone(),
                    adapter_type: facts.device_type.clone(),
                    ..none()
                }
            }
            None => none(),
        }
    }

    /// Runs `plan` on `job`: once, or `repeat` times after a warm-up.
    ///
    /// # Errors
    /// A node reports a problem, memory does not suffice, a value overflows its buffer past growing.
    pub fn run(&self, plan: &Plan, job: &Job, repeat: u32, progress: &Progress) -> Result<Outcome, Problem> {
        let inputs = job.inputs();
        let warm_ups = u32::from(repeat > 1);
        let mut outcome = Outcome { values: Store::new(plan), nodes: node_records(plan), frames_millis: Vec::new() };
        for round in 0..repeat + warm_ups {
            let mut store = Store::new(plan);
            supply(plan, &inputs, &mut store)?;
            let is_timed = round >= warm_ups;
            let start = Instant::now();
            for range in segments(plan) {
                let on = plan.nodes[range.start].on;
                let runs = match on {
                    Backend::Cpu => run_cpu(plan, range, job.image, &mut store, progress)?,
                    Backend::Wgpu => self.run_wgpu(plan, range, job.image, &mut store)?,
                };
                for run in runs {
                    let record = &mut outcome.nodes[run.node];
                    (record.bytes, record.clock) = (run.bytes, run.clock);
                    record.counts = plan.nodes[run.node].pass.counters.iter().map(|c| c.name).zip(run.counts).collect();
                    if is_timed {
                        record.millis.push(run.millis);
                    }
                }
            }
            if is_timed {
                outcome.frames_millis.push(start.elapsed().as_secs_f64() * 1e3);
            }
            outcome.values = store;
        }
        Ok(outcome)
    }

    fn run_wgpu(&self, plan: &Plan, range: Range<usize>, image: [usize; 2], store: &mut Store) -> Result<Vec<Ran>, Problem> {
        let Some(session) = &self.session else {
            return Err(Problem::new(Kind::Device, "a node is pinned to wgpu but there is no device").remedy("use --backend wgpu"));
        };
        let segment = Segment::new(plan, range.clone());
        let inputs: Vec<(String, Array)> = segment
            .plan
            .inputs()
            .map(|(inner, slot)| (slot.name.clone(), store.get(segment.slots[inner]).clone()))
            .collect();
        let ran = session.run(&segment.plan, &inputs, image, &Options::default())?;
        for (inner, array) in ran.values {
            store.put(segment.slots[inner], array);
        }
        Ok(Vec::new())
    }
}

/// What one node did in one run.
struct Ran {
    node: usize,
    millis: f64,
    bytes: usize,
    clock: &'static str,
    counts: Vec<u64>,
}
