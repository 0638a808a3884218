//! Runs a plan whose nodes may be on both backends.

use crate::args::BackendChoice;
use crate::job::Job;
use crate::outcome::{NodeRecord, Outcome};
use crate::record::DeviceRecord;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan};
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
            BackendChoice::Wgpu => Ok(Self {
                session: Some(Session::shared()?),
                default_backend: Backend::Wgpu,
                reason: "asked for".into(),
            }),
            BackendChoice::Auto => match Session::shared() {
                Ok(session) if session.facts().device_type != "cpu" => Ok(Self {
                    session: Some(session),
                    default_backend: Backend::Wgpu,
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

    /// Runs `plan` on `job`: once, or `repeat` times after a warm-up. Where some nodes run on each backend, each stretch of nodes on
    /// wgpu is repeated by itself and CPU nodes run once.
    ///
    /// # Errors
    /// A node reports a problem, memory does not suffice, a value overflows its buffer past growing.
    pub fn run(&self, plan: &Plan, job: &Job, repeat: u32, progress: &Progress) -> Result<Outcome, Problem> {
        let inputs = job.inputs();
        let mut outcome = Outcome {
            values: Store::new(plan),
            nodes: node_records(plan),
            frames_millis: Vec::new(),
            runs_count: repeat,
        };
        let (rounds, warm_ups) = if shadowgraph_cpu::runs_all(plan) { (repeat, u32::from(repeat > 1)) } else { (1, 0) };
        for round in 0..rounds + warm_ups {
            let mut store = Store::new(plan);
            supply(plan, &inputs, &mut store)?;
            let mut frame_millis = 0.0;
            for range in segments(plan) {
                let (millis, runs) = match plan.nodes[range.start].on {
                    Backend::Cpu => run_cpu(plan, range, job.image, &mut store, progress)?,
                    Backend::Wgpu => self.run_wgpu(plan, range, job.image, &mut store, repeat)?,
                };
                frame_millis += millis;
                for run in runs {
                    let record = &mut outcome.nodes[run.node];
                    (record.bytes, record.clock) = (run.bytes, run.clock);
                    let names = plan.nodes[run.node].pass.counters.iter().map(|counter| counter.name);
                    record.counts = names.zip(run.counts).collect();
                    if round >= warm_ups {
                        record.millis.extend(run.millis);
                    }
                }
            }
            if round >= warm_ups {
                outcome.frames_millis.push(frame_millis);
            }
            outcome.values = store;
        }
        Ok(outcome)
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

fn node_records(plan: &Plan) -> Vec<NodeRecord> {
    let record = |node: &shadowgraph_core::plan::Node| NodeRecord {
        node: node.id.clone(),
        stage: node.pass.stage.name,
        pass: node.pass.name,
        on: node.on,
        clock: "",
        millis: Vec::new(),
        bytes: 0,
        counts: Vec::new(),
    };
    plan.nodes.iter().map(record).collect()
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
