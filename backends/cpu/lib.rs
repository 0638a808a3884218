//! Runs a plan with the passes' CPU functions: the reference, and the way to run where no adapter exists.
//!
//! Values live in a [`Store`], one array a slot; a transient is dropped after its last reader. Times are wall-clock
//! milliseconds of this process.
#![forbid(unsafe_code)]

mod store;
#[cfg(test)]
mod tests;

pub use store::Store;

use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::{CounterKind, Pass};
use shadowgraph_core::plan::{Backend, Node, Plan};
use shadowgraph_core::problem::{Kind, Problem};
use std::time::Instant;

/// Told the node's id, how much of it is done and how much there is; may be called from any thread.
pub type Progress<'a> = dyn Fn(&str, u64, u64) + Sync + 'a;

/// Output arrays by port name, and counts in the order of the pass's counters.
pub type Outputs = (Vec<(&'static str, Array)>, Vec<u64>);

/// What one node did.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeRun {
    /// Index into [`Plan::nodes`].
    pub node: usize,
    /// Wall-clock time, milliseconds.
    pub millis: f64,
    /// Size of its outputs.
    pub bytes: usize,
    /// Counts in the order of the pass's counters.
    pub counts: Vec<u64>,
}

/// Runs one node of `plan` on the values in `store`, and puts its outputs there.
///
/// # Errors
/// What the pass reports, with the node's id; a counter that had to be zero; a pass without a CPU function.
pub fn run(
    plan: &Plan,
    index: usize,
    image: [usize; 2],
    store: &mut Store,
    progress: &Progress,
) -> Result<NodeRun, Problem> {
    let node = &plan.nodes[index];
    let span = tracing::info_span!("node", id = node.id, pass = node.pass.name);
    let _entered = span.enter();
    let inputs: Vec<_> = node.inputs.iter().map(|(port, slot)| (*port, store.get(*slot))).collect();
    let start = Instant::now();
    let report = |done: u64, total: u64| progress(&node.id, done, total);
    let (outputs, counts) =
        call(node.pass, &node.params, image, inputs, &report).map_err(|problem| named(problem, node))?;
    let millis = start.elapsed().as_secs_f64() * 1e3;
    check_counts(node, &counts)?;
    let bytes = outputs.iter().map(|(_, array)| array.bytes()).sum();
    for (port, array) in outputs {
        if let Some((_, slot)) = node.outputs.iter().find(|(name, _)| *name == port) {
            store.put(*slot, array);
        }
    }
    drop_dead(plan, index, store);
    Ok(NodeRun { node: index, millis, bytes, counts })
}

/// Runs a pass once on arrays given by port name: for tests and tools.
///
/// # Errors
/// What the pass reports; a pass without a CPU function.
pub fn run_node(
    pass: &'static Pass,
    params: &Params,
    image: [usize; 2],
    inputs: &[(&'static str, Array)],
) -> Result<Outputs, Problem> {
    let inputs = inputs.iter().map(|(port, array)| (*port, array)).collect();
    call(pass, params, image, inputs, &|_, _| {})
}

fn call(
    pass: &'static Pass,
    params: &Params,
    image: [usize; 2],
    inputs: Vec<(&'static str, &Array)>,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Outputs, Problem> {
    let Some(function) = pass.cpu else {
        return Err(Problem::new(Kind::Unsupported, format!("pass {pass:?} does not run on the CPU"))
            .remedy("set `on: Wgpu` for it, or choose another pass of the stage"));
    };
    let mut cx = CpuCx::new(pass, params, image, inputs, progress);
    function(&mut cx)?;
    Ok(cx.finish())
}

fn named(problem: Problem, node: &Node) -> Problem {
    if problem.node.is_some() { problem } else { problem.node(&node.id) }
}

/// A count that had to be zero and is not is an error of the run, never a silent hole.
fn check_counts(node: &Node, counts: &[u64]) -> Result<(), Problem> {
    for (counter, count) in node.pass.counters.iter().zip(counts) {
        if let CounterKind::MustBeZero(remedy) = counter.kind
            && *count > 0
        {
            return Err(Problem::new(Kind::Overflow, counter.doc)
                .node(&node.id)
                .expected("0")
                .found(count.to_string())
                .remedy(remedy));
        }
    }
    Ok(())
}

/// Frees transients whose last reader has run. Slots that a later transfer hands over are read by a later node.
fn drop_dead(plan: &Plan, index: usize, store: &mut Store) {
    for (slot_id, slot) in plan.slots.iter().enumerate() {
        if slot.lifetime[1] == index && !slot.keep && slot.on[0] && !is_input(slot) {
            store.take(slot_id);
        }
    }
}

fn is_input(slot: &shadowgraph_core::plan::Slot) -> bool {
    slot.producer == shadowgraph_core::plan::Producer::Input
}

/// Whether every node of `plan` runs here.
pub fn runs_all(plan: &Plan) -> bool {
    plan.nodes.iter().all(|node| node.on == Backend::Cpu)
}
