//! A plan with its nodes on other backends.

use super::{Backend, Node, Plan};

impl Plan {
    /// The plan with each node where `on` says; one whose pass does not run there stays where it is.
    pub fn pinned(&self, on: impl Fn(usize, &Node) -> Backend) -> Self {
        let mut plan = self.clone();
        plan.slots.iter_mut().for_each(|slot| slot.on = [false; 2]);
        for (index, node) in plan.nodes.iter_mut().enumerate() {
            let wanted = on(index, node);
            let runs_there = match wanted {
                Backend::Cpu => node.pass.cpu.is_some(),
                Backend::Wgpu => node.pass.gpu.is_some(),
            };
            if runs_there {
                node.on = wanted;
            }
            for (_, slot) in node.inputs.iter().chain(&node.outputs) {
                plan.slots[*slot].on[node.on as usize] = true;
            }
        }
        plan.steps = plan.ordered_steps();
        plan
    }
}
