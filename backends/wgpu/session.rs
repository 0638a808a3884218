//! A device of our own and runs on it: what programs and tests use.

use crate::adapter::{AdapterFacts, Opened, Wanted, open};
use crate::errors::{device_problem, lost};
use crate::pipeline::Pipelines;
use crate::segment::Segment;
use crate::timing::Clock;
use shadowgraph_core::array::Array;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::plan::{Backend, Grown, Node, Plan, Producer, Slot, SlotId, Step};
use shadowgraph_core::problem::Problem;
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A device, its queue, and the pipelines made so far.
#[derive(Debug)]
pub struct Session {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    facts: AdapterFacts,
    pub(crate) kind: wgpu::DeviceType,
    pub(crate) capabilities: wgpu::DownlevelFlags,
    pub(crate) pipelines: Pipelines,
    /// Why the device is gone, and what it reported outside every error scope.
    pub(crate) reports: Arc<Mutex<Vec<Problem>>>,
}

/// How to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Time each node, at a cost of a submission a node on software rasterisers; off, only the whole frame is timed.
    pub timers: bool,
    /// Frames run first and not timed: the first compiles and allocates.
    pub warm_up: u32,
    /// Frames timed; times are medians.
    pub frames: u32,
    /// Transients share memory as the plan says.
    pub alias: bool,
    /// Fill everything but inputs with all bits set before the first frame.
    pub poison: bool,
    /// How often a run that was too small may be grown and repeated.
    pub regrow: u32,
    /// Most device memory to take, bytes; none: as much as single buffers allow.
    pub budget_bytes: Option<u64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { timers: true, warm_up: 0, frames: 1, alias: true, poison: false, regrow: 4, budget_bytes: None }
    }
}

/// What a run gave.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Values of kept slots, and of those that a node after the range reads, by slot of the plan.
    pub arrays: Vec<(SlotId, Array)>,
    /// Each node that ran, in order.
    pub nodes: Vec<NodeRun>,
    /// Median time of a frame: submit to done, host clock, milliseconds. With node timers on it includes their cost.
    pub frame_millis: f64,
    /// Whose clock timed the nodes.
    pub clock: Clock,
    /// Device memory taken, bytes.
    pub memory_bytes: u64,
    /// Slots that had to grow, with the rows they were given.
    pub grown: Grown,
}

/// What one node did.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeRun {
    /// Index into [`Plan::nodes`].
    pub node: usize,
    /// Median time, milliseconds; none when it was not timed or the device stamped nonsense.
    pub millis: Option<f64>,
    /// Size of its outputs.
    pub bytes: u64,
    /// Size of its scratch memory and counters.
    pub scratch_bytes: u64,
    /// Counts in the order of the pass's counters.
    pub counts: Vec<u64>,
}

/// Output arrays by port name, and counts in the order of the pass's counters.
pub type Outputs = (Vec<(&'static str, Array)>, Vec<u64>);

impl Session {
    /// Opens the best adapter that `wanted` allows.
    ///
    /// # Errors
    /// There is none, or it gives no device.
    pub fn new(wanted: &Wanted) -> Result<Self, Problem> {
        let Opened { facts, kind, capabilities, device, queue } = open(wanted)?;
        let reports = Arc::new(Mutex::new(Vec::new()));
        let report = |reports: &Arc<Mutex<Vec<Problem>>>| {
            let reports = reports.clone();
            move |problem| reports.lock().unwrap_or_else(PoisonError::into_inner).push(problem)
        };
        let uncaptured = report(&reports);
        device.on_uncaptured_error(Arc::new(move |error| uncaptured(device_problem(&error))));
        let gone = report(&reports);
        device.set_device_lost_callback(move |reason, text| gone(lost(&format!("{reason:?}: {text}"))));
        let pipelines = Pipelines::new(&device);
        Ok(Self { device, queue, facts, kind, capabilities, pipelines, reports })
    }

    /// One session for a whole process: tests and tools share it and its pipelines.
    ///
    /// # Errors
    /// As [`Session::new`], every time.
    pub fn shared() -> Result<&'static Self, Problem> {
        static SHARED: OnceLock<Result<Session, Problem>> = OnceLock::new();
        SHARED.get_or_init(|| Self::new(&Wanted::default())).as_ref().map_err(Clone::clone)
    }

    /// The shared session for a test that needs one, or none after saying on stderr that the test is skipped. With
    /// `SHADOWGRAPH_REQUIRE_GPU=1` a missing adapter panics instead.
    pub fn shared_or_skip(test: &str) -> Option<&'static Self> {
        match Self::shared() {
            Ok(session) => Some(session),
            Err(problem) => {
                let required = std::env::var("SHADOWGRAPH_REQUIRE_GPU").is_ok_and(|value| value == "1");
                assert!(!required, "{test}: {problem}");
                eprintln!("SKIPPED {test}: {problem}");
                None
            }
        }
    }

    /// What records say about the adapter.
    pub fn facts(&self) -> &AdapterFacts {
        &self.facts
    }
    /// Whether the device has timestamps.
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
    }
    /// The device, for callers that record work of their own.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }
    /// Its queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Runs a plan whose nodes are all on wgpu, on arrays by input name.
    ///
    /// # Errors
    /// As [`Session::run_nodes`].
    pub fn run(
        &self,
        plan: &Plan,
        inputs: &[(String, Array)],
        image: [usize; 2],
        options: &Options,
    ) -> Result<Outcome, Problem> {
        let by_slot: Vec<Option<&Array>> = plan
            .slots
            .iter()
            .map(|slot| {
                let is_input = slot.producer == Producer::Input;
                inputs.iter().find(|(name, _)| is_input && *name == slot.name).map(|(_, array)| array)
            })
            .collect();
        self.run_nodes(plan, 0..plan.nodes.len(), &|slot| by_slot[slot], image, options)
    }

    /// Runs the nodes `nodes` of `plan`, all on wgpu; `value` gives what they read and do not make, by slot. So a caller can
    /// run the nodes between on another backend and hand values over.
    ///
    /// # Errors
    /// A missing value or feature, memory that does not fit, an overflow that was not allowed to grow or did not settle, a
    /// count that had to be zero, or what the device reports.
    pub fn run_nodes<'a>(
        &self,
        plan: &Plan,
        nodes: Range<usize>,
        value: &dyn Fn(SlotId) -> Option<&'a Array>,
        image: [usize; 2],
        options: &Options,
    ) -> Result<Outcome, Problem> {
        let segment = Segment::new(plan, nodes.clone());
        let inputs = segment.inputs(value)?;
        let (mut outcome, verdict) = self.run_grown(&segment.plan, &inputs, image, options)?;
        if let Some(problem) = verdict {
            return Err(problem);
        }
        outcome.arrays.iter_mut().for_each(|(slot, _)| *slot = segment.slots[*slot]);
        outcome.nodes.iter_mut().for_each(|run| run.node += nodes.start);
        Ok(outcome)
    }

    /// Runs one pass on arrays given by port name: for tests and tools. Outputs that were too small are grown; a count that
    /// had to be zero is returned like the others, for the caller to look at.
    ///
    /// # Errors
    /// As [`Session::run_nodes`].
    pub fn run_node(
        &self,
        pass: &'static Pass,
        params: &Params,
        image: [usize; 2],
        inputs: &[(&'static str, Array)],
    ) -> Result<Outputs, Problem> {
        let plan = plan_of(pass, params, inputs);
        let values: Vec<(SlotId, &Array)> = inputs.iter().enumerate().map(|(slot, (_, array))| (slot, array)).collect();
        let options = Options { timers: false, ..Options::default() };
        let (outcome, _) = self.run_grown(&plan, &values, image, &options)?;
        let port = |slot: SlotId| plan.slots[slot].port.name;
        let outputs = outcome.arrays.into_iter().map(|(slot, array)| (port(slot), array)).collect();
        Ok((outputs, outcome.nodes.into_iter().flat_map(|run| run.counts).collect()))
    }
}

/// A plan of one node whose inputs are slots 0.. in the order given, every output kept.
fn plan_of(pass: &'static Pass, params: &Params, inputs: &[(&'static str, Array)]) -> Plan {
    let mut plan = Plan { name: pass.name.into(), steps: vec![Step::Run(0)], ..Plan::default() };
    let mut node = Node {
        id: pass.name.into(),
        pass,
        params: params.clone(),
        on: Backend::Wgpu,
        inputs: Vec::new(),
        outputs: Vec::new(),
    };
    let mut enter = |name: &'static str, producer: Producer, keep: bool| {
        let Some(port) = pass.stage.port(name) else { unreachable!("{pass:?} has no port {name}") };
        let id = plan.slots.len();
        let name = if keep { format!("{}.{name}", pass.name) } else { name.to_owned() };
        plan.slots.push(Slot { name, port: *port, producer, lifetime: [0, 0], keep, on: [false, true], alias: id });
        id
    };
    node.inputs = inputs.iter().map(|(port, _)| (*port, enter(port, Producer::Input, false))).collect();
    node.outputs = pass.stage.outputs().map(|port| (port.name, enter(port.name, Producer::Node(0), true))).collect();
    plan.nodes.push(node);
    plan
}
