//! The plan: all that a backend ever sees.

#[cfg(test)]
mod chain;
mod given;
mod order;

#[cfg(test)]
use chain::chain;
mod pinned;

use crate::array::Element;
use crate::param::Params;
use crate::pass::Pass;
use crate::port::{Port, Storage};
use crate::problem::{Kind, Problem};
use crate::size::SizeCx;

/// Where a node runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Backend {
    /// The CPU functions.
    Cpu,
    /// The GPU recipes.
    Wgpu,
}

/// Index into [`Plan::slots`].
pub type SlotId = usize;

/// One live node, in the order of execution.
#[derive(Clone, Debug)]
pub struct Node {
    /// Its id in the graph file.
    pub id: String,
    /// What runs.
    pub pass: &'static Pass,
    /// Checked parameters.
    pub params: Params,
    /// Where.
    pub on: Backend,
    /// Connected input ports that the pass reads.
    pub inputs: Vec<(&'static str, SlotId)>,
    /// Every output port.
    pub outputs: Vec<(&'static str, SlotId)>,
}

/// Who gives a slot its value.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Producer {
    /// The host or the program, before the run.
    Input,
    /// A node, by index into [`Plan::nodes`].
    Node(usize),
}

/// One value that travels.
#[derive(Clone, Debug)]
pub struct Slot {
    /// `node.port`, or the input's name.
    pub name: String,
    /// Its port at the producing side.
    pub port: Port,
    /// Who makes it.
    pub producer: Producer,
    /// First and last node (index) that touches it.
    pub lifetime: [usize; 2],
    /// Whether the value must outlive the run: an output of the graph, or asked for by a dump.
    pub keep: bool,
    /// Nodes run on the CPU, on wgpu, that touch it: where both are set a transfer is inserted.
    pub on: [bool; 2],
    /// Transients with equal numbers share memory. Inputs and kept slots have a number of their own.
    pub alias: usize,
}

/// A step of the run.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// Run node (index).
    Run(usize),
    /// Make slot's value visible to the other backend.
    Transfer {
        /// Which.
        slot: SlotId,
        /// To where.
        to: Backend,
    },
}

/// Nodes in order, slots with lifetimes, steps with transfers.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Name of the graph.
    pub name: String,
    /// Live nodes in order.
    pub nodes: Vec<Node>,
    /// Slots.
    pub slots: Vec<Slot>,
    /// Order of execution with transfers.
    pub steps: Vec<Step>,
    /// Slots that are the graph's outputs, with the names the file gives them.
    pub outputs: Vec<(String, SlotId)>,
    /// Nodes of the file that are not run, with the reason.
    pub left_out: Vec<(String, String)>,
}

/// Shape of every slot of a plan, and words that an earlier run found to be needed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shapes(pub Vec<Vec<usize>>);

/// Capacities to grow to: (slot name, rows).
pub type Grown = Vec<(String, usize)>;

impl Slot {
    /// Word type.
    pub fn element(&self) -> Element {
        self.port.element
    }
    /// GPU memory.
    pub fn storage(&self) -> Storage {
        self.port.storage
    }
}

impl Plan {
    /// The slot called `name`.
    pub fn slot(&self, name: &str) -> Option<SlotId> {
        self.slots.iter().position(|slot| slot.name == name)
    }
    /// Slots that must be supplied before the run.
    pub fn inputs(&self) -> impl Iterator<Item = (SlotId, &Slot)> {
        self.slots.iter().enumerate().filter(|(_, slot)| slot.producer == Producer::Input)
    }
    /// Features the wgpu nodes need, without repetition.
    pub fn required_features(&self) -> Vec<crate::pass::Feature> {
        let mut features = Vec::new();
        for node in self.nodes.iter().filter(|node| node.on == Backend::Wgpu) {
            for feature in node.pass.features {
                if !features.contains(feature) {
                    features.push(*feature);
                }
            }
        }
        features
    }
    /// Shape of every slot, from the shapes of the inputs by name and the picture's width and height.
    ///
    /// # Errors
    /// A missing input, by name.
    pub fn shapes(&self, inputs: &[(String, Vec<usize>)], image: [usize; 2], grown: &Grown) -> Result<Shapes, Problem> {
        let mut shapes: Vec<Vec<usize>> = vec![Vec::new(); self.slots.len()];
        for (id, slot) in self.inputs() {
            let given = inputs.iter().find(|(name, _)| *name == slot.name);
            let Some((_, shape)) = given else {
                return Err(Problem::new(Kind::Missing, "graph input is not supplied")
                    .port(&slot.name)
                    .expected(slot.port.type_text()));
            };
            shapes[id] = shape.clone();
        }
        for node in &self.nodes {
            let read: Vec<_> = node.inputs.iter().map(|(port, slot)| (*port, shapes[*slot].clone())).collect();
            let prefix = format!("{}.", node.id);
            let grown: Vec<_> = node
                .outputs
                .iter()
                .filter_map(|(port, _)| {
                    let name = format!("{prefix}{port}");
                    grown.iter().find(|(slot, _)| *slot == name).map(|(_, rows)| (*port, *rows))
                })
                .collect();
            let cx = SizeCx { image, params: &node.params, inputs: &read, grown: &grown };
            for (port, shape) in (node.pass.size)(&cx) {
                match node.outputs.iter().find(|(name, _)| *name == port) {
                    Some((_, slot)) => shapes[*slot] = shape,
                    None => unreachable!("{:?} sizes unknown port {port}", node.pass),
                }
            }
        }
        Ok(Shapes(shapes))
    }
}
