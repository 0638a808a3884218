//! What all variants on a scene start from: the scene with so many light samples, view-samples, and the truth about them.

use super::number::Number;
use super::run::How;
use super::suite::SceneEntry;
use crate::answers::{Answers, view_samples};
use crate::args::{BackendChoice, GraphChoice};
use crate::converged::converged;
use crate::engine::Machine;
use crate::graph_choice;
use crate::job::Job;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan, Slot};
use shadowgraph_core::problem::{Problem, Problems};
use shadowgraph_core::shared::FACING_AWAY;
use shadowgraph_graph::{Keep, plan_id};
use std::collections::HashMap;

/// Takes a plan into a number: nodes, passes, parameters, and the sources of the passes.
pub fn take_plan(number: &mut Number, plan: &Plan) {
    number.text(&plan_id(plan));
    plan.nodes.iter().filter_map(|node| shadowgraph_passes::source_id(node.pass)).for_each(|id| number.text(id));
}

/// A number of what a variant of so many light samples is judged by: what `reference` light samples are, as one of them does not show
/// a light's shape, and the graphs that make view-samples and truths.
///
/// # Errors
/// What is wrong with scene, view or flags.
pub fn truth_number(light_samples: u32, reference: u32, jobs: &mut Jobs, how: &How) -> Result<Number, Problems> {
    let of_set = reference.min(MOST_OF_SET);
    let light = jobs.get(of_set)?;
    let mut number = Number::default();
    number.word(reference);
    number.text(&jobs.number(of_set, &light).hex());
    for count in [1, light_samples, of_set] {
        take_plan(&mut number, &truth_plan(&jobs.get(count)?, how)?);
    }
    if reference > MOST_OF_SET {
        take_plan(&mut number, &sets_plan(&light, how)?);
    }
    Ok(number)
}

/// Most light samples of one set.
pub const MOST_OF_SET: u32 = 4096;

/// The scene with so many light samples, loaded once each.
pub struct Jobs<'a> {
    scene: &'a SceneEntry,
    jobs: HashMap<u32, Result<Job, Problem>>,
    numbers: HashMap<u32, Number>,
}

impl<'a> Jobs<'a> {
    /// Nothing is loaded yet.
    pub fn new(scene: &'a SceneEntry) -> Self {
        Self { scene, jobs: HashMap::new(), numbers: HashMap::new() }
    }

    /// The scene with so many light samples.
    ///
    /// # Errors
    /// What is wrong with scene, view or flags.
    pub fn get(&mut self, light_samples: u32) -> Result<Job, Problems> {
        let load = || {
            let mut choice = self.scene.choice.clone();
            choice.light.light_samples = Some(light_samples);
            Job::load(&choice)
        };
        Ok(self.jobs.entry(light_samples).or_insert_with(load).clone()?)
    }

    /// A number of everything that graphs read.
    pub fn number(&mut self, light_samples: u32, job: &Job) -> Number {
        let number = || {
            let mut number = Number::default();
            for (name, array) in job.inputs() {
                number.text(&name);
                number.array(&array);
            }
            number
        };
        *self.numbers.entry(light_samples).or_insert_with(number)
    }
}

/// States of view-samples: facing away where they do so for any of the sets. A mean over sets that disagree is no visible fraction.
fn faces_all_sets(machine: &Machine, plan: &Plan, job: &Job, sets: usize) -> Result<Array, Problems> {
    let mut only = plan.clone();
    only.slots.iter_mut().for_each(|slot| slot.keep = slot.port.quantity == "sample_state");
    only.outputs.clear();
    let only = only.given(|_| false);
    let mut states: Option<Vec<u32>> = None;
    for job in job.in_sets(sets)? {
        let outcome = machine.run(&only, &job, 1, &|_, _, _| {})?;
        let kept = only.slots.iter().position(|slot| slot.keep).and_then(|id| outcome.values.try_get(id));
        let Some(kept) = kept else { continue };
        let merged = match states {
            None => kept.as_u32().to_vec(),
            Some(earlier) => {
                let away = |pair: (&u32, &u32)| if *pair.0 == FACING_AWAY { *pair.0 } else { *pair.1 };
                kept.as_u32().iter().zip(&earlier).map(away).collect()
            }
        };
        states = Some(merged);
    }
    let states = states.unwrap_or_default();
    Ok(Array::u32([states.len()], states))
}

/// Truths about a scene's view-samples by number of light samples, and the view-samples themselves.
#[derive(Default)]
pub struct Truths {
    view_samples: Option<Vec<(String, Array)>>,
    answers: HashMap<u32, Answers>,
}

impl Truths {
    /// View-samples that every variant answers for.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn view_samples(&mut self, jobs: &mut Jobs, how: &How) -> Result<Vec<(String, Array)>, Problems> {
        if let Some(known) = &self.view_samples {
            return Ok(known.clone());
        }
        let job = jobs.get(1)?;
        let plan = truth_plan(&job, how)?;
        let machine = Machine::new(BackendChoice::Cpu)?;
        let made = view_samples(&machine, &plan, &job, &|_, _, _| {})?;
        self.view_samples = Some(made.clone());
        Ok(made)
    }

    /// What visible fractions and pictures are compared with. A light without extent needs one sample; one set of samples is asked
    /// with exact predicates; more are the mean over disjoint sets by `soft_shafts`, which is exact for each sample too, and much faster.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn reference(&mut self, light_samples: u32, jobs: &mut Jobs, how: &How) -> Result<Answers, Problems> {
        let light = jobs.get(light_samples.min(MOST_OF_SET))?.light;
        if !shadowgraph_scenes::lights::has_extent(&light) {
            return self.about(1, jobs, how);
        }
        if light_samples <= MOST_OF_SET {
            return self.about(light_samples, jobs, how);
        }
        if let Some(known) = self.answers.get(&light_samples) {
            return Ok(known.clone());
        }
        let job = jobs.get(MOST_OF_SET)?.importing(self.view_samples(jobs, how)?);
        let plan = sets_plan(&job, how)?;
        let progress = |node: &str, done, total| how.bar.set(&format!("reference, {node}"), done, total);
        let sets = (light_samples / MOST_OF_SET) as usize;
        let machine = Machine::new(BackendChoice::Cpu)?;
        // What is not a mean over sets is that of one of them.
        let mut answers = Answers::of(&plan, &machine.run(&plan, &job, 1, &progress)?, &job)?;
        let means = converged(&machine, &plan, &job, sets, &progress)?;
        let mean = |quantity: &str| {
            let made = |slot: &&Slot| slot.port.quantity == quantity && slot.name.contains('.');
            let name = &plan.slots.iter().find(made)?.name;
            plan.slot(name).and_then(|id| means.values.try_get(id)).cloned()
        };
        (answers.mask, answers.visible, answers.image) = (None, mean("fraction"), mean("radiance"));
        answers.state = faces_all_sets(&machine, &plan, &job, sets)?;
        answers.light_samples = light_samples as usize;
        self.answers.insert(light_samples, answers.clone());
        Ok(answers)
    }

    /// The truth for so many light samples.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn about(&mut self, light_samples: u32, jobs: &mut Jobs, how: &How) -> Result<Answers, Problems> {
        if let Some(known) = self.answers.get(&light_samples) {
            return Ok(known.clone());
        }
        let job = jobs.get(light_samples)?.importing(self.view_samples(jobs, how)?);
        let plan = truth_plan(&job, how)?;
        let progress =
            |_: &str, done, total| how.bar.set(&format!("truth of {light_samples} light samples"), done, total);
        let outcome = Machine::new(BackendChoice::Cpu)?.run(&plan, &job, 1, &progress)?;
        let answers = Answers::of(&plan, &outcome, &job)?;
        self.answers.insert(light_samples, answers.clone());
        Ok(answers)
    }
}

fn truth_plan(job: &Job, how: &How) -> Result<Plan, Problems> {
    plan_of(if job.light_samples_count() == 1 { "truth_hard" } else { "truth_soft" }, job, how)
}

/// Answers for one of several sets.
fn sets_plan(job: &Job, how: &How) -> Result<Plan, Problems> {
    plan_of("soft_shafts", job, how)
}

fn plan_of(graph: &str, job: &Job, how: &How) -> Result<Plan, Problems> {
    let choice = GraphChoice { graph: graph.into(), ..GraphChoice::default() };
    graph_choice::plan(&choice, how.catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)
}
