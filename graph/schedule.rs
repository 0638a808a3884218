//! Order, slots, lifetimes, steps.

use crate::alias::alias;
use crate::resolve::{From, Resolved};
use crate::wire::Wired;
use crate::world::Selection;
use petgraph::graph::{DiGraph, NodeIndex};
use shadowgraph_core::plan::{Backend, Node, Plan, Producer, Slot, SlotId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Live nodes and who feeds whom, with the ports at both ends.
pub(crate) type Edges = DiGraph<usize, (&'static str, &'static str)>;

pub(crate) fn edges(resolved: &Resolved, wired: &Wired) -> Edges {
    let mut edges = Edges::new();
    let mut at: Vec<Option<NodeIndex>> = vec![None; resolved.nodes.len()];
    for (index, _) in wired.is_live.iter().enumerate().filter(|(_, is_live)| **is_live) {
        at[index] = Some(edges.add_node(index));
    }
    for (reader, inputs) in wired.inputs.iter().enumerate() {
        for (input, from) in inputs {
            if let From::Node(source, output) = from
                && let (Some(source), Some(reader)) = (at[*source], at[reader])
            {
                edges.add_edge(source, reader, (output.name, input));
            }
        }
    }
    edges
}

/// Nodes so that each comes after what it reads; among those that could come next, the first of the file. Shorter than
/// the graph when there is a circle.
pub(crate) fn order(edges: &Edges) -> Vec<usize> {
    let mut waits: Vec<usize> =
        edges.node_indices().map(|node| edges.neighbors_directed(node, petgraph::Incoming).count()).collect();
    let mut ready: BinaryHeap<Reverse<(usize, NodeIndex)>> =
        edges.node_indices().filter(|node| waits[node.index()] == 0).map(|node| Reverse((edges[node], node))).collect();
    let mut order = Vec::with_capacity(waits.len());
    while let Some(Reverse((index, node))) = ready.pop() {
        order.push(index);
        for reader in edges.neighbors(node) {
            waits[reader.index()] -= 1;
            if waits[reader.index()] == 0 {
                ready.push(Reverse((edges[reader], reader)));
            }
        }
    }
    order
}

/// What [`schedule`] puts together.
pub(crate) struct Scheduled<'a, 'g> {
    pub resolved: &'a Resolved<'g>,
    pub selection: &'a Selection,
    pub wired: &'a Wired,
    pub order: &'a [usize],
    /// Backend of each node of `order`.
    pub on: &'a [Backend],
    pub keep_all: bool,
    pub alias: bool,
}

/// The plan, without its name and what was left out.
pub(crate) fn schedule(parts: &Scheduled) -> Plan {
    let Scheduled { resolved, selection, wired, .. } = *parts;
    let mut plan = Plan::default();
    let mut input_slots: Vec<Option<SlotId>> = vec![None; resolved.inputs.len()];
    // First slot of each node of the file; its outputs follow in the order of the stage.
    let mut first_slots: Vec<SlotId> = vec![0; resolved.nodes.len()];
    for (position, index) in parts.order.iter().enumerate() {
        let node = &resolved.nodes[*index];
        let Some(choice) = selection.chosen[*index].map(|choice| &node.choices[choice]) else {
            unreachable!("{} is live and has no pass", node.id.text)
        };
        let mut inputs = Vec::with_capacity(wired.inputs[*index].len());
        for (port, from) in &wired.inputs[*index] {
            inputs.push((*port, slot_of(*from, parts, &mut plan, &mut input_slots, &first_slots)));
        }
        first_slots[*index] = plan.slots.len();
        let mut outputs = Vec::new();
        for port in choice.pass.stage.outputs() {
            outputs.push((port.name, plan.slots.len()));
            plan.slots.push(Slot {
                name: format!("{}.{}", node.id.text, port.name),
                port: *port,
                producer: Producer::Node(position),
                lifetime: [position, position],
                keep: parts.keep_all,
                on: [false; 2],
                alias: 0,
            });
        }
        let on = parts.on[position];
        for (_, slot) in inputs.iter().chain(&outputs) {
            let slot = &mut plan.slots[*slot];
            if slot.on == [false; 2] {
                slot.lifetime[0] = position;
            }
            slot.lifetime[1] = position;
            slot.on[on as usize] = true;
        }
        let (id, params) = (node.id.text.clone(), choice.params.clone());
        plan.nodes.push(Node { id, pass: choice.pass, params, on, inputs, outputs });
    }
    for (name, _, from) in &resolved.outputs {
        let slot = slot_of(*from, parts, &mut plan, &mut input_slots, &first_slots);
        plan.slots[slot].keep = true;
        plan.outputs.push((name.to_string(), slot));
    }
    alias(&mut plan.slots, parts.alias);
    plan.steps = plan.ordered_steps();
    plan
}

fn slot_of(
    from: From,
    parts: &Scheduled,
    plan: &mut Plan,
    input_slots: &mut [Option<SlotId>],
    first_slots: &[SlotId],
) -> SlotId {
    match from {
        From::Input(index) => *input_slots[index].get_or_insert_with(|| {
            let port = *parts.resolved.inputs[index];
            plan.slots.push(Slot {
                name: port.name.into(),
                port,
                producer: Producer::Input,
                lifetime: [0, 0],
                keep: false,
                on: [false; 2],
                alias: 0,
            });
            plan.slots.len() - 1
        }),
        From::Node(node, port) => {
            let outputs = parts.resolved.nodes[node].stage.into_iter().flat_map(|stage| stage.outputs());
            let position = outputs.take_while(|output| output.name != port.name).count();
            first_slots[node] + position
        }
    }
}
