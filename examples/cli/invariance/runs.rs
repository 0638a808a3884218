//! Runs of a graph, and two of them port by port.

use super::{Difference, Verdict};
use crate::engine::Machine;
use crate::job::Job;
use crate::port_difference::{Around, Comparison, port_difference};
use crate::stretch::How;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::{Node, Plan, SlotId};
use shadowgraph_core::problem::Problem;
use shadowgraph_cpu::Store;
use shadowgraph_wgpu::Options;

/// Values of one run by the names of their slots.
pub struct Values<'a> {
    plan: &'a Plan,
    inputs: Vec<(String, Array)>,
    store: Store,
}

impl<'a> Values<'a> {
    /// Runs `plan` once.
    pub fn run(machine: &Machine, plan: &'a Plan, job: &Job, options: &Options) -> Result<Self, Problem> {
        let silent = |_: &str, _: u64, _: u64| {};
        let how = How { timers: options.timers, options: options.clone(), ..How::once(machine, job, &silent) };
        let (_, store) = machine.frame(plan, &[], &how)?;
        Ok(Self::of(plan, job, store))
    }

    /// Of a run that was done.
    pub fn of(plan: &'a Plan, job: &Job, store: Store) -> Self {
        Self { plan, inputs: job.inputs(), store }
    }

    fn of_slot(&self, slot: SlotId) -> Option<&Array> {
        let name = &self.plan.slots[slot].name;
        let input = || self.inputs.iter().find(|(input, _)| input == name).map(|(_, array)| array);
        self.store.try_get(slot).or_else(input)
    }

    /// What `node` reads or makes at `port`.
    fn around(&self, node: &str, port: &str) -> Option<&Array> {
        let node = self.plan.nodes.iter().find(|other| other.id == node)?;
        let (_, slot) = node.inputs.iter().chain(&node.outputs).find(|(name, _)| *name == port)?;
        self.of_slot(*slot)
    }
}

/// Compares every output of every node of the first run with that of the second, bits and sets.
pub fn compare(one: &Values, other: &Values, job: &Job) -> Verdict {
    compare_nodes(one, other, job, |_| true)
}

/// As [`compare`], of the outputs of the nodes that `is_compared` names.
pub fn compare_nodes(one: &Values, other: &Values, job: &Job, is_compared: impl Fn(&Node) -> bool) -> Verdict {
    let lights = job.light_samples_count();
    let (mut compared_count, mut not_compared_count, mut ports) = (0, 0, Vec::new());
    let mut differing: Vec<SlotId> = Vec::new();
    for node in &one.plan.nodes {
        let begins_here = node.inputs.iter().all(|(_, slot)| !differing.contains(slot));
        for (port, slot) in &node.outputs {
            match of_port(node, port, one, other, lights) {
                _ if !is_compared(node) => not_compared_count += 1,
                Comparison::NotCompared { .. } => not_compared_count += 1,
                comparison if comparison.differs() => {
                    differing.push(*slot);
                    let (node, pass) = (node.id.clone(), node.pass.name);
                    ports.push(Difference { node, pass, port, comparison, begins_here });
                }
                _ => compared_count += 1,
            }
        }
    }
    match ports.is_empty() {
        true => Verdict::Same { compared_count, not_compared_count },
        false => Verdict::Differs { ports },
    }
}

fn of_port(node: &Node, port: &str, one: &Values, other: &Values, lights: usize) -> Comparison {
    let arounds: [Around; 2] = [&|name| one.around(&node.id, name), &|name| other.around(&node.id, name)];
    let shapes = arounds.map(|around| around(port).map(|array| array.shape().to_vec()));
    let comparison = port_difference(node, port, Contract::Exact, arounds, lights);
    match (&comparison, shapes) {
        // Both are there and are not even alike.
        (Comparison::NotCompared { why }, [Some(one), Some(other)]) if one != other => {
            Comparison::Differs { count: 1, of: 1, first_row: 0, what: format!("shapes: {why}") }
        }
        _ => comparison,
    }
}
