//! How wrong each side is, and what in B is to blame for it.

use super::side::{Ran, Side};
use crate::answers::{Answers, Truth, errors};
use crate::args::GraphChoice;
use crate::engine::Machine;
use crate::graph_choice;
use crate::job::Job;
use serde::Serialize;
use shadowgraph_charts::model::Errors;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Backend, Plan, Producer, Slot};
use shadowgraph_core::problem::Problems;
use shadowgraph_cpu::Progress;
use shadowgraph_graph::Keep;

/// The truth about the view-samples and light samples of one side, with every value kept.
pub struct TrueRun {
    plan: Plan,
    ran: Ran,
    /// What can be compared.
    pub truth: Truth,
}

impl TrueRun {
    /// Runs the graph called `truth`, else `truth_hard` for one light sample and `truth_soft` for more, on the CPU and on the
    /// view-samples of `answers`.
    ///
    /// # Errors
    /// What is wrong with that graph; as [`Machine::run`].
    pub fn new(
        truth: Option<&str>,
        answers: &Answers,
        job: &Job,
        catalogue: &Catalogue,
        machine: &Machine,
        progress: &Progress,
    ) -> Result<Self, Problems> {
        let graph = truth.unwrap_or(if job.light_samples_count() == 1 { "truth_hard" } else { "truth_soft" });
        let choice = GraphChoice { graph: graph.into(), ..GraphChoice::default() };
        let job = job.importing(answers.imports());
        let plan = graph_choice::plan(&choice, catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)?;
        let side = Side { choice, job, plan };
        let ran = Ran::new(machine, &side, Vec::new(), |_| false, progress)?;
        let truth = Truth { bits: None, grey: ran.answers(&side)? };
        Ok(Self { plan: side.plan, ran, truth })
    }

    /// The truth's value of a slot: that of the same node and port, else one of the same quantity and shape, if it makes one.
    fn value(&self, slot: &Slot, shape: &[usize]) -> Option<&Array> {
        let is_alike = |other: &&Slot| other.port.quantity == slot.port.quantity;
        let alike = || self.plan.slots.iter().filter(is_alike);
        let same = alike().filter(|other| other.name == slot.name);
        let values = same.chain(alike()).filter_map(|slot| self.ran.values.get(&slot.name));
        values.into_iter().find(|array| array.shape() == shape)
    }
}

/// What replacing one node's outputs by the truth's takes away of the error.
#[derive(Clone, Debug, Serialize)]
pub struct Blame {
    /// The node; `light samples` for the number of them.
    pub node: String,
    /// The error that is left.
    pub errors: Errors,
    /// Share of the whole error that goes away by wrong bits, else by RMSE over all view-samples; below zero where it grows.
    /// None where there is no error to begin with.
    pub removed_share: Option<f64>,
}

/// Replaces the outputs of one node of `side` at a time by the truth's of the same quantities, runs what follows, and looks at the
/// error again. Nodes for which the truth has no such values are told apart: nothing is known of them.
///
/// # Errors
/// As [`Machine::run`].
pub fn attribute(
    side: &Side,
    ran: &Ran,
    of: &TrueRun,
    whole: &Errors,
    machine: &Machine,
    progress: &Progress,
) -> Result<(Vec<Blame>, Vec<String>), Problems> {
    let (mut blames, mut unknown) = (Vec::new(), Vec::new());
    for (index, node) in side.plan.nodes.iter().enumerate() {
        // View-samples are those of both; what makes the picture is not judged by bits.
        if ["view_samples", "sample_filter", "shade", "bent_light"].contains(&node.pass.stage.name) {
            continue;
        }
        let mut given = Vec::new();
        for (_, slot) in &node.outputs {
            let slot = &side.plan.slots[*slot];
            let shape = ran.values.get(&slot.name).map_or(&[] as &[usize], |array| array.shape());
            given.extend(of.value(slot, shape).map(|array| (slot.name.clone(), array.clone())));
        }
        if given.len() < node.outputs.len() {
            unknown.push(node.id.clone());
            continue;
        }
        for (id, slot) in side.plan.slots.iter().enumerate() {
            let upstream = matches!(slot.producer, Producer::Node(maker) if maker < index);
            if upstream && !given.iter().any(|(name, _)| *name == slot.name) {
                given.extend(ran.values.get(&side.plan.slots[id].name).map(|array| (slot.name.clone(), array.clone())));
            }
        }
        let upstream: Vec<&str> = side.plan.nodes[..=index].iter().map(|node| node.id.as_str()).collect();
        let replaced = Ran::new(machine, side, given, |node| upstream.contains(&node.id.as_str()), progress)?;
        let left = errors(&replaced.answers(side)?, &of.truth)?;
        blames.push(Blame { node: node.id.clone(), removed_share: removed(whole, &left), errors: left });
    }
    blames.sort_by(|a, b| b.removed_share.unwrap_or(0.0).total_cmp(&a.removed_share.unwrap_or(0.0)));
    Ok((blames, unknown))
}

/// Share of the error `whole` that is not in `left`.
fn removed(whole: &Errors, left: &Errors) -> Option<f64> {
    let bits = whole.wrong_bit_share.zip(left.wrong_bit_share).filter(|(whole, _)| *whole > 0.0);
    let grey = whole.rmse_all.zip(left.rmse_all).filter(|(whole, _)| *whole > 0.0);
    bits.or(grey).map(|(whole, left)| 1.0 - left / whole)
}

/// Why two sides of one comparison may have a truth each: other light samples, or other view-samples.
pub fn need_own_truth(a: &Answers, b: &Answers) -> bool {
    a.light_samples != b.light_samples || a.position != b.position || a.pixel != b.pixel
}
