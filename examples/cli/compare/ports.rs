//! Values of two runs, node by node: where they begin to differ.

use super::side::{Ran, Side};
use crate::port_difference::{Around, Comparison, misfilled, port_difference};
use serde::Serialize;
use shadowgraph_core::array::Array;
use shadowgraph_core::param::Value;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::{Node, SlotId};
use std::collections::HashSet;

/// Stages that lay out what others found: of another superset they make another table, and masks made from it are still the same.
const TABLES: [&str; 2] = ["scan", "caster_fill"];

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
    /// Whether it is a mask and both sides asked the same: of the same view-samples, light samples and casters. Then tables on the way
    /// excuse nothing.
    pub is_same_question: bool,
}

impl PortRow {
    /// Whether values begin to differ here.
    pub fn is_origin(&self) -> bool {
        self.inputs_are_equivalent
            && !self.comparison.is_equivalent()
            && !matches!(self.comparison, Comparison::NotCompared { .. })
    }

    /// Whether values differ otherwise than the contract allows: where they begin to, or in a mask that must be the same.
    pub fn is_fault(&self) -> bool {
        (self.is_origin() || self.is_same_question) && self.comparison.differs()
    }
}

/// Compares all outputs of nodes that both sides have under one name and stage; those in `shared` are the same values.
///
/// What a node reads is equivalent where it comes from nodes with equivalent values, or is the same value.
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
    let mut uncompared: HashSet<SlotId> = HashSet::new();
    // Equivalent, and other sets.
    let mut alike: HashSet<SlotId> = HashSet::new();
    let mut rows = Vec::new();
    let asks_the_same = unequal.is_empty() && QUESTION.iter().all(|quantity| made(a, quantity) == made(b, quantity));
    for (index, node) in b.0.plan.nodes.iter().enumerate() {
        if shared.iter().any(|(of_b, _)| *of_b == index) {
            continue;
        }
        let twin =
            a.0.plan.nodes.iter().find(|other| other.id == node.id && other.pass.stage.name == node.pass.stage.name);
        let Some(twin) = twin else {
            // What only B has cannot be compared: what reads it is.
            uncompared.extend(node.outputs.iter().map(|(_, slot)| *slot));
            continue;
        };
        let around_a: Around = &|port| a.1.around(&a.0.plan, twin, &inputs[0], port);
        let around_b: Around = &|port| b.1.around(&b.0.plan, node, &inputs[1], port);
        let was_compared = |port: &str, slot: &SlotId| {
            let of_a = twin.inputs.iter().find(|(name, _)| *name == port);
            let is_rewired = of_a.is_some_and(|(_, of_a)| a.0.plan.slots[*of_a].name != b.0.plan.slots[*slot].name);
            !is_rewired && !uncompared.contains(slot)
        };
        let is_equivalent = |(port, slot): &(&'static str, SlotId)| {
            !unequal.contains(slot)
                && (was_compared(port, slot)
                    || around_a(port).zip(around_b(port)).is_none_or(|(one, other)| one == other))
        };
        let inputs_are_equivalent = node.inputs.iter().all(is_equivalent);
        for (port, slot) in &node.outputs {
            let is_same_question = *port == "mask" && asks_the_same;
            // One pass need not repeat itself bit by bit on other tables.
            let contract = match inputs_are_equivalent {
                false if *port == "mask" => looser(twin.pass.contract, node.pass.contract),
                _ => allowed(twin, node),
            };
            let mut comparison = port_difference(node, port, contract, [around_a, around_b], lights);
            // A mask answers the same question whatever the parameters are.
            if *port != "mask" && have_other_parameters(twin, node) {
                comparison = comparison.of_other_parameters();
            }
            let follows = inputs_are_equivalent && node.inputs.iter().any(|(_, slot)| alike.contains(slot));
            if follows && TABLES.contains(&node.pass.stage.name) && !comparison.is_equivalent() {
                comparison = Comparison::Allowed { why: "follows from what it reads".into(), is_other_set: true };
                // Tables of other pairs are not comparable with each other: each is with its own pairs.
                if node.pass.stage.name == "caster_fill"
                    && let Some(wrong) = misfilled(around_a).or_else(|| misfilled(around_b))
                {
                    comparison = wrong;
                }
            }
            match comparison {
                Comparison::Equal | Comparison::Allowed { is_other_set: false, .. } => {}
                Comparison::Allowed { .. } => _ = alike.insert(*slot),
                _ => _ = unequal.insert(*slot),
            }
            rows.push(PortRow { node: node.id.clone(), port, comparison, inputs_are_equivalent, is_same_question });
        }
    }
    rows
}

/// What a mask answers for, beside the graph's inputs.
const QUESTION: [&str; 6] = ["position", "normal", "triangle_of_sample", "pixel", "sample_state", "caster_state"];

/// The first value of a quantity that a node made.
fn made<'a>((side, ran): (&Side, &'a Ran), quantity: &str) -> Option<&'a Array> {
    let slots = side.plan.slots.iter().filter(|slot| slot.port.quantity == quantity);
    slots.into_iter().find_map(|slot| ran.values.get(&slot.name))
}

/// Whether a parameter that both have has another value.
fn have_other_parameters(one: &Node, other: &Node) -> bool {
    let is_other = |(name, value): &(&str, Value)| one.params.0.iter().any(|(of, was)| of == name && was != value);
    other.params.0.iter().any(is_other)
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
