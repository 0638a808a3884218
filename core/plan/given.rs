//! A plan of which some values are known already: for runs that share a beginning, and for asking what a node is to blame for.

use super::{Node, Plan, Producer, SlotId, Step};

impl Plan {
    /// The plan without the nodes for which `is_given` holds: what they make is an input, under the name that the slot has. Nodes
    /// whose values nobody reads or keeps any more are left out too, with that reason.
    pub fn given(&self, is_given: impl Fn(&Node) -> bool) -> Self {
        let given: Vec<bool> = self.nodes.iter().map(is_given).collect();
        let mut is_needed: Vec<bool> = self.slots.iter().map(|slot| slot.keep).collect();
        let mut is_live = vec![false; self.nodes.len()];
        for (index, node) in self.nodes.iter().enumerate().rev() {
            is_live[index] = !given[index] && node.outputs.iter().any(|(_, slot)| is_needed[*slot]);
            if is_live[index] {
                node.inputs.iter().for_each(|(_, slot)| is_needed[*slot] = true);
            }
        }
        let mut plan = Self { nodes: Vec::new(), steps: Vec::new(), ..self.clone() };
        for (id, slot) in plan.slots.iter_mut().enumerate() {
            (slot.lifetime, slot.on) = ([0, 0], [false; 2]);
            if matches!(slot.producer, Producer::Node(node) if !is_live[node]) {
                // A given value shares memory with nothing.
                (slot.producer, slot.alias) = (Producer::Input, self.slots.len() + id);
            }
        }
        for (index, node) in self.nodes.iter().enumerate() {
            if !is_live[index] {
                let why = if given[index] { "what it makes is given" } else { "what follows it is given" };
                plan.left_out.push((node.id.clone(), why.into()));
                continue;
            }
            let position = plan.nodes.len();
            for (_, id) in node.inputs.iter().chain(&node.outputs) {
                let slot = &mut plan.slots[*id];
                if slot.on == [false; 2] {
                    slot.lifetime[0] = position;
                }
                slot.lifetime[1] = position;
                slot.on[node.on as usize] = true;
            }
            node.outputs.iter().for_each(|(_, slot)| plan.slots[*slot].producer = Producer::Node(position));
            plan.nodes.push(node.clone());
        }
        plan.drop_unused();
        plan.steps = plan.ordered_steps();
        plan
    }

    /// Forgets slots that no node touches and nobody keeps.
    fn drop_unused(&mut self) {
        let stays: Vec<bool> = self.slots.iter().map(|slot| slot.on != [false; 2] || slot.keep).collect();
        let place = |id: SlotId| stays[..id].iter().filter(|stays| **stays).count();
        for node in &mut self.nodes {
            node.inputs.iter_mut().chain(&mut node.outputs).for_each(|(_, slot)| *slot = place(*slot));
        }
        self.outputs.iter_mut().for_each(|(_, slot)| *slot = place(*slot));
        let mut stays = stays.iter();
        self.slots.retain(|_| stays.next() == Some(&true));
    }

    /// Every node, with a transfer before the first use of a value on a backend where it is not yet. A graph input is where its
    /// first reader is.
    pub fn ordered_steps(&self) -> Vec<Step> {
        let mut is_at = vec![[false; 2]; self.slots.len()];
        let mut steps = Vec::with_capacity(self.nodes.len());
        for (index, node) in self.nodes.iter().enumerate() {
            let on = node.on as usize;
            for (_, slot) in &node.inputs {
                let is_new = is_at[*slot] == [false; 2];
                if !is_new && !is_at[*slot][on] {
                    steps.push(Step::Transfer { slot: *slot, to: node.on });
                }
                is_at[*slot][on] = true;
            }
            for (_, slot) in &node.outputs {
                is_at[*slot][on] = true;
            }
            steps.push(Step::Run(index));
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::super::chain;
    use super::*;

    #[test]
    fn nothing_given_changes_nothing_but_lifetimes() {
        let (plan, same) = (chain(), chain().given(|_| false));
        assert_eq!(same.steps, plan.steps);
        assert_eq!(same.steps.len(), 5, "{:?}", same.steps);
        assert_eq!(same.slots.iter().map(|slot| slot.lifetime).collect::<Vec<_>>(), [[0, 0], [0, 1], [1, 2], [2, 2]]);
    }

    #[test]
    fn what_a_given_value_makes_needless_is_left_out_and_said() {
        let plan = chain().given(|node| node.id == "b");
        assert_eq!(plan.nodes.iter().map(|node| node.id.as_str()).collect::<Vec<_>>(), ["c"]);
        assert_eq!(plan.inputs().map(|(_, slot)| slot.name.as_str()).collect::<Vec<_>>(), ["b.to"]);
        assert_eq!((plan.outputs[0].1, plan.slots[1].producer.clone()), (1, Producer::Node(0)));
        let left_out: Vec<_> = plan.left_out.iter().map(|(node, why)| format!("{node}: {why}")).collect();
        assert_eq!(left_out, ["a: what follows it is given", "b: what it makes is given"]);
        assert_eq!(plan.steps, [Step::Run(0)]);
    }

    #[test]
    fn kept_values_of_given_nodes_are_inputs() {
        let mut whole = chain();
        whole.slots[1].keep = true;
        let plan = whole.given(|node| node.id != "c");
        let names: Vec<_> = plan.inputs().map(|(_, slot)| slot.name.as_str()).collect();
        assert_eq!(names, ["a.to", "b.to"]);
    }
}
