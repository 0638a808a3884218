//! One side of a comparison: a graph, planned for correctness with every value kept, and what it answered.

use crate::answers::Answers;
use crate::args::{GraphChoice, SceneChoice};
use crate::engine::Machine;
use crate::graph_choice;
use crate::job::Job;
use crate::outcome::Outcome;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Backend, Node, Plan, Producer};
use shadowgraph_core::problem::Problems;
use shadowgraph_cpu::Progress;
use shadowgraph_graph::Keep;
use std::collections::HashMap;

/// A graph on a scene.
pub struct Side {
    /// What was asked for.
    pub choice: GraphChoice,
    /// Its scene, camera and light samples.
    pub job: Job,
    /// Every live port kept.
    pub plan: Plan,
}

impl Side {
    /// Plans `choice` on the scene, with as many light samples as the command line, else the graph says.
    ///
    /// # Errors
    /// What is wrong with scene, graph or flags.
    pub fn new(
        choice: GraphChoice,
        scene: &SceneChoice,
        catalogue: &Catalogue,
        machine: &mut Machine,
    ) -> Result<Self, Problems> {
        let job = Job::load(&scene.for_graph(graph_choice::light_samples(&choice)?))?;
        let plan =
            graph_choice::plan(&choice, catalogue, Some(&job.facts), machine.default_backend, Keep::AllLivePorts)?;
        machine.ready_for(&plan)?;
        Ok(Self { choice, job, plan })
    }

    /// The same side with its nodes on other backends.
    pub fn with(&self, on: impl Fn(usize, &Node) -> Backend) -> Self {
        Self { choice: self.choice.clone(), job: self.job.clone(), plan: self.plan.pinned(on) }
    }

    /// The plan with only the graph's outputs kept: what is timed.
    ///
    /// # Errors
    /// As [`Side::new`].
    pub fn timed_plan(&self, catalogue: &Catalogue, machine: &Machine) -> Result<Plan, Problems> {
        let keep = Keep::OutputsOnly;
        graph_choice::plan(&self.choice, catalogue, Some(&self.job.facts), machine.default_backend, keep)
    }
}

/// Every value of a run by slot name.
pub struct Ran {
    /// What ran; nodes that were given are not in it.
    pub outcome: Outcome,
    /// Values of all nodes of the side's plan, given ones too.
    pub values: HashMap<String, Array>,
}

impl Ran {
    /// Runs `side`, but for nodes whose values are given by slot name.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn new(
        machine: &Machine,
        side: &Side,
        given: Vec<(String, Array)>,
        is_given: impl Fn(&Node) -> bool,
        progress: &Progress,
    ) -> Result<Self, Problems> {
        let plan = side.plan.given(is_given);
        let outcome = machine.run_given(&plan, &side.job, &given, 1, progress)?;
        let mut values: HashMap<String, Array> = given.into_iter().collect();
        for (id, slot) in plan.slots.iter().enumerate() {
            if let (Producer::Node(_), Some(array)) = (&slot.producer, outcome.values.try_get(id)) {
                values.insert(slot.name.clone(), array.clone());
            }
        }
        Ok(Self { outcome, values })
    }

    /// The value of an output port of a node.
    pub fn output(&self, node: &str, port: &str) -> Option<&Array> {
        self.values.get(&format!("{node}.{port}"))
    }

    /// What a node reads or makes, by port.
    pub fn around<'a>(
        &'a self,
        plan: &'a Plan,
        node: &'a Node,
        inputs: &'a [(String, Array)],
        port: &str,
    ) -> Option<&'a Array> {
        let (_, slot) = node.inputs.iter().chain(&node.outputs).find(|(name, _)| *name == port)?;
        let name = &plan.slots[*slot].name;
        self.values.get(name).or_else(|| inputs.iter().find(|(input, _)| input == name).map(|(_, array)| array))
    }

    /// Its answers.
    ///
    /// # Errors
    /// The graph keeps nothing that can be judged.
    pub fn answers(&self, side: &Side) -> Result<Answers, Problems> {
        Ok(Answers::of_values(&side.plan, |name| self.values.get(name).cloned(), &side.job)?)
    }
}
