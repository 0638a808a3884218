//! The same plan in another legal order: an order that a run must not depend on.

use super::{Plan, Producer, SlotId};
use crate::problem::{Kind, Problem};

impl Plan {
    /// The plan with its nodes in `order`, given by their indices here. Slots keep their numbers; no two share memory, as what may
    /// share hangs on the order.
    ///
    /// # Errors
    /// A node is missing or there twice, or comes before one whose value it reads.
    pub fn in_order(&self, order: &[usize]) -> Result<Self, Problem> {
        let mut place: Vec<Option<usize>> = vec![None; self.nodes.len()];
        let wrong = |message: &str, node: &str| Err(Problem::new(Kind::BadValue, message).node(node));
        let mut plan = Self { nodes: Vec::with_capacity(order.len()), ..self.clone() };
        for slot in &mut plan.slots {
            (slot.lifetime, slot.on) = ([0, 0], [false; 2]);
        }
        for (position, index) in order.iter().enumerate() {
            let Some(node) = self.nodes.get(*index) else {
                return wrong("an order names a node that is not there", &format!("{index}"));
            };
            if place[*index].replace(position).is_some() {
                return wrong("an order names a node twice", &node.id);
            }
            for (_, slot) in &node.inputs {
                if matches!(self.slots[*slot].producer, Producer::Node(producer) if place[producer].is_none()) {
                    return wrong("an order puts a node before one whose value it reads", &node.id);
                }
            }
            for (_, slot) in node.inputs.iter().chain(&node.outputs) {
                let slot = &mut plan.slots[*slot];
                if slot.on == [false; 2] {
                    slot.lifetime[0] = position;
                }
                slot.lifetime[1] = position;
                slot.on[node.on as usize] = true;
            }
            node.outputs.iter().for_each(|(_, slot)| plan.slots[*slot].producer = Producer::Node(position));
            plan.nodes.push(node.clone());
        }
        if let Some(missing) = place.iter().position(Option::is_none) {
            return wrong("an order misses a node", &self.nodes[missing].id);
        }
        plan.slots.iter_mut().enumerate().for_each(|(id, slot)| slot.alias = id);
        plan.steps = plan.ordered_steps();
        Ok(plan)
    }

    /// A legal order that `seed` decides: of the nodes that could come next, any with the same chance.
    pub fn shuffled_order(&self, seed: u64) -> Vec<usize> {
        let producer = |slot: &SlotId| match self.slots[*slot].producer {
            Producer::Node(node) => Some(node),
            Producer::Input => None,
        };
        let reads = |node: usize| self.nodes[node].inputs.iter().filter_map(|(_, slot)| producer(slot));
        let mut is_done = vec![false; self.nodes.len()];
        let mut order = Vec::with_capacity(self.nodes.len());
        let mut state = seed;
        while order.len() < self.nodes.len() {
            let could = |node: &usize| !is_done[*node] && reads(*node).all(|read| is_done[read]);
            let next: Vec<usize> = (0..self.nodes.len()).filter(could).collect();
            let Some(chosen) = next.get((random(&mut state) % next.len().max(1) as u64) as usize) else {
                unreachable!("nodes of plan {} feed each other in a circle", self.name)
            };
            is_done[*chosen] = true;
            order.push(*chosen);
        }
        order
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut mixed = *state;
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

#[cfg(test)]
mod tests {
    use super::super::chain;
    use super::*;
    use crate::plan::Step;

    /// a -> b -> c as `chain`, and d, which reads what a makes.
    fn fork() -> Plan {
        let mut plan = chain();
        let mut node = plan.nodes[2].clone();
        node.id = "d".into();
        (node.inputs[0].1, node.outputs[0].1) = (1, 4);
        plan.slots.push(super::super::Slot {
            name: "d.to".into(),
            producer: Producer::Node(3),
            ..plan.slots[3].clone()
        });
        plan.nodes.push(node);
        plan.steps = plan.ordered_steps();
        plan
    }

    #[test]
    fn shuffled_orders_are_legal_differ_and_repeat() {
        let plan = fork();
        let orders: Vec<Vec<usize>> = (0..20).map(|seed| plan.shuffled_order(seed)).collect();
        for order in &orders {
            let plan = plan.in_order(order).unwrap();
            let at = |id: &str| plan.nodes.iter().position(|node| node.id == id).unwrap();
            assert!(at("a") < at("b") && at("b") < at("c") && at("a") < at("d"), "{order:?}");
            assert_eq!(plan.slots[2].producer, Producer::Node(at("b")));
            assert_eq!(plan.slots[1].lifetime, [at("a"), at("b").max(at("d"))]);
            assert_eq!(plan.steps.iter().filter(|step| matches!(step, Step::Run(_))).count(), 4);
        }
        assert_eq!(plan.shuffled_order(7), orders[7]);
        let mut different = orders;
        different.sort();
        different.dedup();
        assert_eq!(different.len(), 3, "every legal order is found: d after a, after b or last");
    }

    #[test]
    fn orders_that_are_not_legal_are_refused() {
        let plan = fork();
        for (order, says) in [
            (vec![1, 0, 2, 3], "b: an order puts a node before one whose value it reads"),
            (vec![0, 1, 1, 3], "b: an order names a node twice"),
            (vec![0, 1, 2], "d: an order misses a node"),
            (vec![0, 1, 2, 9], "9: an order names a node that is not there"),
        ] {
            assert_eq!(plan.in_order(&order).unwrap_err().to_string(), says);
        }
    }
}
