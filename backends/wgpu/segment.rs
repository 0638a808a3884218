//! A run of nodes as a plan of its own, so that a caller can do the nodes between on another backend.

use shadowgraph_core::plan::{Plan, Producer, Slot, SlotId, Step};
use std::ops::Range;

/// Some consecutive nodes of a plan.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Their plan. What they read and do not make is an input; what they make and a later node reads is kept.
    pub plan: Plan,
    /// The slot of the whole plan behind each slot of [`Segment::plan`].
    pub slots: Vec<SlotId>,
}

impl Segment {
    /// The nodes `nodes` of `whole`.
    pub fn new(whole: &Plan, nodes: Range<usize>) -> Self {
        let mut segment = Self { plan: Plan { name: whole.name.clone(), ..Plan::default() }, slots: Vec::new() };
        for index in nodes.clone() {
            let mut node = whole.nodes[index].clone();
            for (_, slot) in node.inputs.iter_mut().chain(&mut node.outputs) {
                *slot = segment.enter(whole, *slot, &nodes);
            }
            segment.plan.steps.push(Step::Run(index - nodes.start));
            segment.plan.nodes.push(node);
        }
        for (name, slot) in &whole.outputs {
            if let Some(inner) = segment.slots.iter().position(|known| known == slot) {
                segment.plan.outputs.push((name.clone(), inner));
            }
        }
        segment
    }

    /// The segment's number of slot `outer`, entered at its first mention.
    fn enter(&mut self, whole: &Plan, outer: SlotId, nodes: &Range<usize>) -> SlotId {
        if let Some(known) = self.slots.iter().position(|slot| *slot == outer) {
            return known;
        }
        let slot = &whole.slots[outer];
        let producer = match slot.producer {
            Producer::Node(node) if nodes.contains(&node) => Producer::Node(node - nodes.start),
            _ => Producer::Input,
        };
        let made_here = producer != Producer::Input;
        let keep = made_here && (slot.keep || slot.lifetime[1] >= nodes.end);
        // What crosses the border keeps its value over repeated runs, so it shares memory with nothing.
        let alias = if made_here && !keep { slot.alias } else { whole.slots.len() + outer };
        let lifetime = slot.lifetime.map(|node| node.clamp(nodes.start, nodes.end - 1) - nodes.start);
        self.plan.slots.push(Slot { producer, keep, alias, lifetime, ..slot.clone() });
        self.slots.push(outer);
        self.slots.len() - 1
    }
}
