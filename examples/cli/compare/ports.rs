//! Values of two runs, node by node: where they begin to differ.

use super::side::{Ran, Side};
use crate::port_difference::{Around, Comparison, port_difference};
use serde::Serialize;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::{Node, SlotId};
use std::collections::HashSet;

/// One output of a node that both sides have.
#[derive(Clone, Debug, Serialize)]
pub struct PortRow {
    /// The node.
    pub node: String,
    /// Its port.
    pub port: &'static str,
    /// How the two values compare.
    pub comparison: Comparison,
    /// Whether all that the node read was equivalent: else the difference may come from there.
    pub inputs_are_equivalent: bool,
}

impl PortRow {
    /// Whether values begin to differ here.
    pub fn is_origin(&self) -> bool {
        self.inputs_are_equivalent
            && !self.comparison.is_equivalent()
            && !matches!(self.comparison, Comparison::NotCompared { .. })
    }

    /// Whether they do so otherwise than the contract allows.
    pub fn is_fault(&self) -> bool {
        self.is_origin() && self.comparison.differs()
    }
}

/// Compares all outputs of nodes that both sides have under one name and stage; those in `shared` are the same values.
pub fn compare(a: (&Side, &Ran), b: (&Side, &Ran), shared: &[(usize, usize)]) -> Vec<PortRow> {
    let inputs = [a.0.job.inputs(), b.0.job.inputs()];
    let lights = b.0.job.light_samples_count();
    let mut unequal: HashSet<SlotId> = HashSet::new();
    for (id, slot) in b.0.plan.inputs() {
        let of =
            |inputs: &[(String, Array)]| inputs.iter().find(|(name, _)| *name == slot.name).map(|(_, a)| a.clone());
        if of(&inputs[0]) != of(&inputs[1]) {
            unequal.insert(id);
        }
    }
    let mut rows = Vec::new();
    for (index, node) in b.0.plan.nodes.iter().enumerate() {
        if shared.iter().any(|(of_b, _)| *of_b == index) {
            continue;
        }
        let twin =
            a.0.plan.nodes.iter().find(|other| other.id == node.id && other.pass.stage.name == node.pass.stage.name);
        let Some(twin) = twin else {
            // What only B has cannot be compared: what reads it is.
            continue;
        };
        let inputs_are_equivalent = node.inputs.iter().all(|(_, slot)| !unequal.contains(slot));
        let around_a: Around = &|port| a.1.around(&a.0.plan, twin, &inputs[0], port);
        let around_b: Around = &|port| b.1.around(&b.0.plan, node, &inputs[1], port);
        for (port, slot) in &node.outputs {
            let contract = allowed(twin, node);
            let comparison = port_difference(node, port, contract, [around_a, around_b], lights);
            if !comparison.is_equivalent() {
                unequal.insert(*slot);
            }
            rows.push(PortRow { node: node.id.clone(), port, comparison, inputs_are_equivalent });
        }
    }
    rows
}

/// What two nodes of one stage may differ by: the same pass with the same parameters must repeat itself on one backend, others
/// may do what the looser of both contracts says.
pub fn allowed(one: &Node, other: &Node) -> Contract {
    let is_same = one.pass.name == other.pass.name && one.params == other.params && one.on == other.on;
    if is_same {
        return Contract::Exact;
    }
    looser(one.pass.contract, other.pass.contract)
}

fn looser(one: Contract, other: Contract) -> Contract {
    let rank = |contract: Contract| match contract {
        Contract::Exact => 0,
        Contract::Sets => 1,
        Contract::Within(_) => 2,
        Contract::WrongBits(_) => 3,
        Contract::Superset => 4,
        Contract::Approximate => 5,
    };
    match (one, other) {
        (Contract::Within(a), Contract::Within(b)) => Contract::Within(a.max(b)),
        (Contract::WrongBits(a), Contract::WrongBits(b)) => Contract::WrongBits(a.max(b)),
        _ if rank(one) >= rank(other) => one,
        _ => other,
    }
}
