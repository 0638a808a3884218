//! Runs a suite: case by case, in each all methods on the same frames, with one truth for all of them.

use super::frame::{Bench, Frame};
use super::judge::{Motion, decide, judge};
use super::records::{PICTURES, Records};
use super::suite::{Method, SceneEntry, SequenceEntry, Suite};
use super::{place, suite};
use crate::answers::{Answers, Truth};
use crate::chart::number::Number;
use crate::engine::Machine;
use crate::graph_choice;
use crate::outcome::Outcome;
use crate::record::WGPU_VERSION;
use crate::shard::Shard;
use shadowgraph_charts::model::{Expected, Provenance, Stability, StabilityFrame, Temporal, Verdict, Worst};
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Plan, Producer};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::{Keep, plan_id};
use shadowgraph_passes::ports::LIST_LENGTH;
use std::collections::HashMap;
use std::path::Path;

/// Where and how a suite runs.
pub struct Runner<'a> {
    /// The suite.
    pub suite: &'a Suite,
    /// All passes.
    pub catalogue: &'a Catalogue,
    /// What methods run on.
    pub machine: &'a mut Machine,
    /// What view-samples and truths are made on: a CPU backend.
    pub cpu: &'a Machine,
    /// Folder of records and pictures.
    pub folder: &'a Path,
    /// Names of methods to run; empty: all.
    pub methods: &'a [String],
    /// Names of scenes to run; empty: all.
    pub scenes: &'a [String],
    /// Which part of the cases to run.
    pub shard: Shard,
    /// When this run started, ISO 8601.
    pub started: String,
    /// Told what is about to run, how many records are done and how many there are.
    pub progress: &'a dyn Fn(&str, usize, usize),
}

/// A record that the suite asks for.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Its number.
    pub id: String,
    /// Whether an earlier run or another shard had measured it.
    pub was_there: bool,
}

impl Runner<'_> {
    /// Runs what has no record yet, and says what was asked for, in the order of the suite. Records of an earlier run are judged again, so that a suite with other thresholds or
    /// expectations needs no second measurement.
    ///
    /// # Errors
    /// A scene that cannot be loaded; files that cannot be written. What keeps a single method from running becomes its record.
    pub fn run(&mut self, records: &mut Records) -> Result<Vec<Asked>, Problems> {
        let suite = self.suite;
        let is_chosen = |names: &[String], name: &str| names.is_empty() || names.iter().any(|chosen| chosen == name);
        let takes = |position: usize, scene: usize| {
            self.shard.takes(position) && is_chosen(self.scenes, &suite.scenes[scene].name)
        };
        let cases = suite.cases().into_iter().enumerate();
        let cases: Vec<_> = cases.filter(|(at, (scene, _))| takes(*at, *scene)).map(|(_, case)| case).collect();
        let methods: Vec<usize> =
            (0..suite.methods.len()).filter(|index| is_chosen(self.methods, &suite.methods[*index].name)).collect();
        let total = cases.len() * methods.len();
        let mut asked = Vec::new();
        for (scene, sequence) in cases {
            let (entry, along) = (&suite.scenes[scene], &suite.sequences[sequence]);
            let title = format!("{}, {}", entry.name, suite::parameter(along.change).0);
            (self.progress)(&title, asked.len(), total);
            let frames = Bench { catalogue: self.catalogue, cpu: self.cpu }.frames(suite, entry, along)?;
            let mut case = Case { entry, along, frames, truths: HashMap::new() };
            for index in &methods {
                let method = &suite.methods[*index];
                (self.progress)(&format!("{title}: {}", method.name), asked.len(), total);
                let says = suite.expected(*index, scene, along.change);
                let ready = self.ready(&case, method)?;
                let earlier = records.find(&ready.id);
                let was_there = earlier.is_some();
                let record = match earlier {
                    Some(earlier) => judged_again(earlier, method, says),
                    None => Some(self.record(&mut case, method, &ready, says)?),
                };
                if let Some(record) = record {
                    records.add(record)?;
                }
                asked.push(Asked { id: ready.id, was_there });
            }
        }
        (self.progress)("", total, total);
        Ok(asked)
    }

    /// Plans a method for every frame.
    fn ready(&mut self, case: &Case, method: &Method) -> Result<Ready, Problem> {
        let device = self.machine.record();
        let mut id = Number::default();
        // Two methods may come to one plan, on a light that is not planar, say: the name keeps their records apart.
        for text in [&method.name, &case.entry.name, &case.entry.choice.scene, &self.suite.size] {
            id.text(text);
        }
        id.text(&format!("{} {} {}", device.backend, device.adapter, device.driver));
        id.text(&format!("{} {}", method.light_samples, method.truth_light_samples));
        id.text(&format!("{:?} {}", case.along.change, self.suite.contact_ulps));
        let mut plans = Ok(Vec::new());
        let (mut lacks, mut scene) = (None, None);
        for frame in &case.frames {
            let job = frame.job(method.light_samples)?;
            if let Some(fact) = method.needs.as_ref().filter(|fact| job.facts.get(fact) != Some(true)) {
                lacks.get_or_insert_with(|| fact.clone());
            }
            let backend = self.machine.default_backend;
            let plan =
                graph_choice::plan(&method.choice, self.catalogue, Some(&job.facts), backend, Keep::AllLivePorts)
                    .and_then(|plan| self.machine.ready_for(&plan).map_err(Problems::from).map(|()| plan));
            let mut inputs = Number::default();
            for (name, array) in job.inputs() {
                inputs.text(&name);
                inputs.array(&array);
            }
            id.text(&inputs.hex());
            id.text(&frame.value.to_string());
            scene.get_or_insert(inputs.hex());
            match plan {
                Ok(plan) => {
                    id.text(&plan_id(&plan));
                    let passes = plan.nodes.iter().map(|node| node.pass);
                    passes.filter_map(shadowgraph_passes::source_id).for_each(|source| id.text(source));
                    plans = plans.map(|mut plans: Vec<Plan>| {
                        plans.push(plan);
                        plans
                    });
                }
                Err(problems) => {
                    id.text(&problems.to_string());
                    plans = plans.and(Err(problems));
                }
            }
        }
        Ok(Ready { id: id.hex(), plans, lacks, scene: scene.unwrap_or_default() })
    }

    /// Runs a method on every frame of a case.
    fn record(
        &mut self,
        case: &mut Case,
        method: &Method,
        ready: &Ready,
        (mut expected, mut why): (Expected, String),
    ) -> Result<Stability, Problems> {
        let mut ran = Ran::default();
        let not_run = match (&ready.lacks, &ready.plans) {
            (Some(fact), _) => {
                (expected, why) = (Expected::Open, format!("the method is for scenes with {fact}"));
                Some(format!("the scene has not: {fact}"))
            }
            (None, Err(problems)) => {
                if problems.0.iter().all(|problem| matches!(problem.kind, Kind::Unsupported | Kind::Device)) {
                    (expected, why) = (Expected::Open, "the method does not run on this backend".into());
                }
                Some(problems.to_string())
            }
            (None, Ok(plans)) => self.frames(case, method, plans, &mut ran)?,
        };
        let decision = decide(&method.judge, &ran.frames);
        let verdict = not_run.map_or(decision.verdict, |why| Verdict::NotRun { why });
        let worst = match &verdict {
            Verdict::NotRun { .. } => None,
            verdict => self.worst(&ran, decision.worst_frame, &ready.id, *verdict == Verdict::Fails)?,
        };
        let (parameter, unit, _) = suite::parameter(case.along.change);
        let device = self.machine.record();
        let plan = ready.plans.as_ref().ok().and_then(|plans| plans.first());
        let pair = |text: &String| text.split_once('=').map(|(place, value)| (place.to_string(), value.to_string()));
        let choice = &method.choice;
        Ok(Stability {
            id: ready.id.clone(),
            suite: self.suite.name.clone(),
            graph: choice.graph.clone(),
            choices: choice.swap.iter().chain(&choice.set).filter_map(pair).collect(),
            label: method.name.clone(),
            backend: device.backend.into(),
            scene: case.entry.name.clone(),
            view: case.entry.choice.view.clone().unwrap_or_default(),
            sequence: case.along.change,
            parameter: parameter.into(),
            unit: unit.into(),
            frames: ran.frames,
            temporal: ran.temporal,
            worst,
            judged_by: decision.judged_by.into(),
            figure: decision.figure.filter(|_| !matches!(verdict, Verdict::NotRun { .. })),
            threshold: Some(method.judge.at_most),
            verdict,
            expected,
            expected_source: why,
            provenance: Provenance {
                graph_hash: plan.map(plan_id).unwrap_or_default(),
                scene_hash: ready.scene.clone(),
                program_version: env!("CARGO_PKG_VERSION").into(),
                commit: env!("SHADOWGRAPH_COMMIT").into(),
                adapter: device.adapter,
                driver: device.driver,
                adapter_type: device.adapter_type,
                threads: device.threads,
                wgpu_version: WGPU_VERSION.into(),
                started: self.started.clone(),
            },
        })
    }

    /// Why not all frames ran, if so.
    fn frames(
        &mut self,
        case: &mut Case,
        method: &Method,
        plans: &[Plan],
        ran: &mut Ran,
    ) -> Result<Option<String>, Problems> {
        let mut motion = Motion::new(method.light_samples);
        for (index, plan) in plans.iter().enumerate() {
            let truth = self.truth(case, index, method)?;
            let frame = &case.frames[index];
            let result = self.frame(frame, method, plan, &truth, plans.len() > 1 && index == 0);
            let (judged, wrong, answers) = match result {
                Ok(done) => done,
                Err(problem) => return Ok(Some(format!("at {}: {problem}", frame.value))),
            };
            if let Some(from) = frame.steady_from {
                motion.add(&answers, &truth, from)?;
            }
            ran.frames.push(judged);
            ran.answers.push((answers, truth, wrong));
        }
        ran.temporal = motion.finish();
        Ok(None)
    }

    fn frame(
        &self,
        frame: &Frame,
        method: &Method,
        plan: &Plan,
        truth: &Truth,
        is_warmed_up: bool,
    ) -> Result<(StabilityFrame, Vec<f32>, Answers), Problem> {
        let job = frame.job(method.light_samples)?;
        if is_warmed_up {
            self.machine.run(plan, &job, 1, &|_, _, _| {})?;
        }
        let outcome = self.machine.run(plan, &job, 1, &|_, _, _| {})?;
        let answers = Answers::of(plan, &outcome, &job)?;
        let mut judged = judge(method, frame, &answers, truth, self.suite.contact_ulps)?;
        judged.frame.millis = outcome.frames_millis.first().copied();
        judged.frame.longest_list_count = longest_list(plan, &outcome);
        Ok((judged.frame, judged.wrong, answers))
    }

    /// The truth that a method is compared with in a frame, made once for all methods.
    fn truth(&self, case: &mut Case, index: usize, method: &Method) -> Result<Truth, Problems> {
        let bench = Bench { catalogue: self.catalogue, cpu: self.cpu };
        let Case { frames, truths, .. } = case;
        let mut of = |samples: u32| -> Result<Answers, Problems> {
            if let Some(known) = truths.get(&(index, samples)) {
                return Ok(known.clone());
            }
            let truth = bench.truth(&frames[index], samples)?;
            Ok(truths.entry((index, samples)).or_insert(truth).clone())
        };
        let grey = of(method.truth_light_samples)?;
        let bits =
            if method.light_samples == method.truth_light_samples { None } else { Some(of(method.light_samples)?) };
        Ok(Truth { bits, grey })
    }

    fn worst(&self, ran: &Ran, frame: usize, id: &str, is_pictured: bool) -> Result<Option<Worst>, Problem> {
        let Some((answers, truth, wrong)) = ran.answers.get(frame) else { return Ok(None) };
        let Some(pixel) = place::find(answers, wrong) else { return Ok(None) };
        if is_pictured {
            return place::write(self.folder, PICTURES, id, frame, pixel, answers, &truth.grey).map(Some);
        }
        Ok(Some(Worst { frame, pixel, ..Worst::default() }))
    }
}

/// A scene along a sequence, and what is known of it.
struct Case<'s> {
    entry: &'s SceneEntry,
    along: &'s SequenceEntry,
    frames: Vec<Frame>,
    /// By frame and light samples.
    truths: HashMap<(usize, u32), Answers>,
}

/// A method on a case, about to run.
struct Ready {
    id: String,
    /// One a frame.
    plans: Result<Vec<Plan>, Problems>,
    /// The fact that the scene lacks.
    lacks: Option<String>,
    /// Number of the first frame's inputs.
    scene: String,
}

/// What a method did on a case.
#[derive(Default)]
struct Ran {
    frames: Vec<StabilityFrame>,
    temporal: Option<Temporal>,
    /// By frame, with the truth and how wrong each row is.
    answers: Vec<(Answers, Truth, Vec<f32>)>,
}

/// An earlier record under today's threshold and expectation; none where nothing changes.
fn judged_again(earlier: &Stability, method: &Method, (expected, why): (Expected, String)) -> Option<Stability> {
    if matches!(earlier.verdict, Verdict::NotRun { .. }) {
        return None;
    }
    let decision = decide(&method.judge, &earlier.frames);
    let pixel = earlier.worst.as_ref().filter(|worst| worst.frame == decision.worst_frame).cloned();
    let record = Stability {
        label: method.name.clone(),
        judged_by: decision.judged_by.into(),
        figure: decision.figure,
        threshold: Some(method.judge.at_most),
        verdict: decision.verdict,
        worst: pixel,
        expected,
        expected_source: why,
        ..earlier.clone()
    };
    (record != *earlier).then_some(record)
}

/// Entries of the longest list: counted by the node that builds lists, else found in the lengths it made.
fn longest_list(plan: &Plan, outcome: &Outcome) -> Option<u64> {
    let builds = |stage: &str| stage == "list_build";
    let counts = outcome.nodes.iter().filter(|node| builds(node.stage)).flat_map(|node| &node.counts);
    let counted = counts.filter(|(name, _)| name.contains("longest")).map(|(_, count)| *count).max();
    counted.or_else(|| {
        let made = |slot: &shadowgraph_core::plan::Slot| match slot.producer {
            Producer::Node(node) => builds(plan.nodes[node].pass.stage.name) && slot.port.name == LIST_LENGTH.name,
            Producer::Input => false,
        };
        let slot = plan.slots.iter().position(made)?;
        outcome.values.try_get(slot)?.as_u32().iter().max().map(|length| u64::from(*length))
    })
}
