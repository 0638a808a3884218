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
use std::cmp::Ordering;

/// The truth about the view-samples and light samples of one side, with every value kept.
pub struct TrueRun {
    plan: Plan,
    ran: Ran,
    /// What it answers.
    pub answers: Answers,
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
        let answers = ran.answers(&side)?;
        Ok(Self { plan: side.plan, ran, answers })
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

/// Runs of the truth about both sides: bits are judged for each side's own light samples, visible fractions and pictures of both for
/// the larger number of them.
pub struct Truths {
    /// About the light samples of A; none where that of B says the same.
    own_a: Option<TrueRun>,
    /// About the light samples of B.
    pub own_b: TrueRun,
    /// About the side with fewer light samples, where its view-samples are not the other's: as many light samples as that has.
    converged: Option<TrueRun>,
}

impl Truths {
    /// Runs what is needed of `truth` about the jobs and answers of A and B; see [`TrueRun::new`].
    ///
    /// # Errors
    /// As [`TrueRun::new`].
    pub fn new(
        truth: Option<&str>,
        answers: [&Answers; 2],
        jobs: [&Job; 2],
        catalogue: &Catalogue,
        machine: &Machine,
        progress: &Progress,
    ) -> Result<Self, Problems> {
        let [a, b] = answers;
        let run = |answers: &Answers, job: &Job| TrueRun::new(truth, answers, job, catalogue, machine, progress);
        let own_b = run(b, jobs[1])?;
        let is_same_view = a.position == b.position && a.pixel == b.pixel;
        let own_a = match is_same_view && a.light_samples == b.light_samples {
            true => None,
            false => Some(run(a, jobs[0])?),
        };
        let converged = match (is_same_view, a.light_samples.cmp(&b.light_samples)) {
            (true, _) | (_, Ordering::Equal) => None,
            (false, Ordering::Less) => Some(run(a, jobs[1])?),
            (false, Ordering::Greater) => Some(run(b, jobs[0])?),
        };
        Ok(Self { own_a, own_b, converged })
    }

    /// What A and B are judged by.
    pub fn of_both(&self) -> [Truth; 2] {
        let own = [&self.own_a.as_ref().unwrap_or(&self.own_b).answers, &self.own_b.answers];
        let most = own[0].light_samples.max(own[1].light_samples);
        let grey = |side: usize| match &self.converged {
            _ if own[side].light_samples == most => own[side],
            Some(converged) => &converged.answers,
            None => own[1 - side],
        };
        [0, 1].map(|side| Truth { bits: Some(own[side].clone()), grey: grey(side).clone() })
    }
}

/// What replacing one node's outputs by the truth's takes away of the error.
#[derive(Clone, Debug, Serialize)]
pub struct Blame {
    /// The node; [`LIGHT_SAMPLES`] for the number of them.
    pub node: String,
    /// The error that is left.
    pub errors: Errors,
    /// Share of the whole error that goes away by wrong bits, else by RMSE over all view-samples; below zero where it grows. Of
    /// the number of light samples always by RMSE. None where there is no error to begin with.
    pub removed_share: Option<f64>,
}

/// What stands for a node where B is judged by a truth of its own number of light samples, not of the larger one.
pub const LIGHT_SAMPLES: &str = "light samples";

/// Replaces the outputs of one node of `side` at a time by those of the truth `of` its own light samples, runs what follows, and looks
/// at the error again, by `truth`. Returns also the nodes of which nothing is known: the truth has no such values, or they are
/// view-samples, which all runs share, or they make pictures of answers and no answers.
///
/// # Errors
/// As [`Machine::run`].
pub fn attribute(
    side: &Side,
    ran: &Ran,
    of: &TrueRun,
    truth: &Truth,
    whole: &Errors,
    machine: &Machine,
    progress: &Progress,
) -> Result<(Vec<Blame>, Vec<String>), Problems> {
    let (mut blames, mut unknown) = (Vec::new(), Vec::new());
    for (index, node) in side.plan.nodes.iter().enumerate() {
        if ["view_samples", "shade", "bent_light"].contains(&node.pass.stage.name) {
            unknown.push(node.id.clone());
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
        let left = errors(&replaced.answers(side)?, truth)?;
        blames.push(Blame { node: node.id.clone(), removed_share: removed(whole, &left), errors: left });
    }
    if truth.grey.light_samples > side.job.light_samples_count() {
        let own = Truth { bits: None, grey: of.answers.clone() };
        let left = errors(&ran.answers(side)?, &own)?;
        let removed_share = removed_grey(whole, &left);
        blames.push(Blame { node: LIGHT_SAMPLES.into(), removed_share, errors: left });
    }
    blames.sort_by(|a, b| b.removed_share.unwrap_or(0.0).total_cmp(&a.removed_share.unwrap_or(0.0)));
    Ok((blames, unknown))
}

/// Share of the error `whole` that is not in `left`.
fn removed(whole: &Errors, left: &Errors) -> Option<f64> {
    let bits = whole.wrong_bit_share.zip(left.wrong_bit_share).filter(|(whole, _)| *whole > 0.0);
    bits.map(|(whole, left)| 1.0 - left / whole).or_else(|| removed_grey(whole, left))
}

/// The same by visible fractions alone.
fn removed_grey(whole: &Errors, left: &Errors) -> Option<f64> {
    let grey = whole.rmse_all.zip(left.rmse_all).filter(|(whole, _)| *whole > 0.0);
    grey.map(|(whole, left)| 1.0 - left / whole)
}
