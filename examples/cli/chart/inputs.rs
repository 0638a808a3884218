//! What all variants on a scene start from: the scene with so many light samples, view-samples, and the truth about them.

use super::number::Number;
use super::run::How;
use super::suite::SceneEntry;
use crate::answers::{Answers, view_samples};
use crate::args::{BackendChoice, GraphChoice};
use crate::engine::Machine;
use crate::graph_choice;
use crate::job::Job;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::problem::{Problem, Problems};
use shadowgraph_graph::Keep;
use std::collections::HashMap;

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
    let graph = if job.light_samples_count() == 1 { "truth_hard" } else { "truth_soft" };
    let choice = GraphChoice { graph: graph.into(), ..GraphChoice::default() };
    graph_choice::plan(&choice, how.catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)
}
