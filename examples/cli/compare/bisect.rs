//! Which node makes the CPU and wgpu differ: nodes before a cut run on wgpu, those after it on the CPU, and the cut moves by halves.

use super::side::{Ran, Side};
use crate::engine::Machine;
use crate::port_difference::{Around, Comparison, port_difference};
use serde::Serialize;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::{Backend, Node};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_cpu::Progress;

/// One run of the search.
#[derive(Clone, Debug, Serialize)]
pub struct Step {
    /// Nodes up to this one ran on wgpu; none when all ran on the CPU.
    pub up_to: String,
    /// How the answer compares with that of the CPU alone.
    pub comparison: Comparison,
}

/// What the search found.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    /// The answer that is looked at: `node.port`.
    pub output: String,
    /// Its runs, in order.
    pub steps: Vec<Step>,
    /// The node with which the answer begins to differ; none when both backends agree.
    pub node: Option<String>,
    /// That node by itself on both backends, on the CPU's inputs: which of its ports differ.
    pub ports: Vec<(String, Comparison)>,
    /// Nodes that do not run on both backends, and so were no suspects.
    pub on_one_backend: Vec<String>,
}

/// Searches. Both backends get the same view-samples: those of the CPU.
///
/// # Errors
/// The graph makes neither a mask nor visible fractions; there is no device; as [`Machine::run`].
pub fn bisect(side: &Side, machine: &Machine, progress: &Progress) -> Result<Found, Problems> {
    let on_cpu = side.with(|_, _| Backend::Cpu);
    let right = Ran::new(machine, &on_cpu, Vec::new(), |_| false, progress)?;
    let answers = ["mask", "fraction", "radiance"];
    let output = answers.iter().find_map(|quantity| {
        let made = |node: &Node| {
            node.outputs.iter().find(|(_, slot)| side.plan.slots[*slot].port.quantity == *quantity).copied()
        };
        side.plan.nodes.iter().enumerate().rev().find_map(|(index, node)| Some((index, node, made(node)?)))
    });
    let Some((last, node, (port, slot))) = output else {
        return Err(Problem::new(Kind::Missing, "the graph makes no answer that could differ")
            .expected("a mask, visible fractions or a picture")
            .into());
    };
    let output = side.plan.slots[slot].name.clone();
    let view_samples: Vec<usize> = side
        .plan
        .nodes
        .iter()
        .enumerate()
        .filter(|(_, node)| node.pass.stage.name == "view_samples")
        .map(|(index, _)| index)
        .collect();
    let lights = side.job.light_samples_count();
    let mut steps: Vec<Step> = Vec::new();
    // Whether the answer differs when nodes 0..cut run on wgpu.
    let mut differs = |cut: usize| -> Result<bool, Problems> {
        let mixed = side
            .with(|index, _| if index < cut && !view_samples.contains(&index) { Backend::Wgpu } else { Backend::Cpu });
        let ran = Ran::new(machine, &mixed, Vec::new(), |_| false, progress)?;
        let none: &[(String, Array)] = &[];
        let around_right: Around = &|port| right.around(&side.plan, node, none, port);
        let around_mixed: Around = &|port| ran.around(&side.plan, node, none, port);
        let comparison = port_difference(node, port, Contract::Exact, [around_right, around_mixed], lights);
        let is_other = !comparison.is_equivalent();
        let up_to = cut.checked_sub(1).map_or("none".into(), |index| side.plan.nodes[index].id.clone());
        steps.push(Step { up_to, comparison });
        Ok(is_other)
    };
    let on_one_backend = |node: &&Node| node.pass.cpu.is_none() || node.pass.gpu.is_none();
    let on_one_backend = side.plan.nodes.iter().filter(on_one_backend).map(|node| node.id.clone()).collect();
    let mut found = Found { output, steps: Vec::new(), node: None, ports: Vec::new(), on_one_backend };
    if !differs(last + 1)? {
        found.steps = steps;
        return Ok(found);
    }
    // The answer is right with `low` nodes on wgpu and differs with `high`.
    let (mut low, mut high) = (0, last + 1);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if differs(middle)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    found.steps = steps;
    let culprit = &side.plan.nodes[high - 1];
    found.node = Some(culprit.id.clone());
    found.ports = alone(side, &on_cpu, &right, high - 1, machine, progress)?;
    Ok(found)
}

/// One node on wgpu, on inputs that the CPU made: its ports against those of the CPU.
fn alone(
    side: &Side,
    on_cpu: &Side,
    right: &Ran,
    index: usize,
    machine: &Machine,
    progress: &Progress,
) -> Result<Vec<(String, Comparison)>, Problems> {
    let node = &side.plan.nodes[index];
    let mut one = side.with(|_, _| Backend::Wgpu);
    for slot in &mut one.plan.slots {
        slot.keep = false;
    }
    for (_, slot) in &node.outputs {
        one.plan.slots[*slot].keep = true;
    }
    one.plan.outputs.clear();
    let given = right.values.iter().map(|(name, array)| (name.clone(), array.clone())).collect();
    // What is given of the node itself gives way to what it makes.
    let ran = Ran::new(machine, &one, given, |other| other.id != node.id, progress)?;
    let inputs = on_cpu.job.inputs();
    let around_right: Around = &|port| right.around(&side.plan, node, &inputs, port);
    let around_alone: Around = &|port| ran.around(&side.plan, node, &inputs, port);
    let lights = side.job.light_samples_count();
    let compared = node.outputs.iter().map(|(port, _)| {
        let comparison = port_difference(node, port, node.pass.contract, [around_right, around_alone], lights);
        (format!("{}.{port}", node.id), comparison)
    });
    Ok(compared.collect())
}
