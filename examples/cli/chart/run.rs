//! Runs a suite: every variant answers once for the same view-samples and is judged, then all variants of a scene are timed in
//! rounds, so that what slows the machine for a while slows all of them.

use super::inputs::{Jobs, MOST_OF_SET, Truths, take_plan, truth_number};
use super::number::Number;
use super::pictures;
use super::store::{Answer, Round, Store};
use super::suite::{SceneEntry, Suite};
use super::variant::Variant;
use crate::answers::{Answers, Truth, errors_told};
use crate::args::BackendChoice;
use crate::engine::Machine;
use crate::graph_choice;
use crate::record::WGPU_VERSION;
use crate::report::Bar;
use crate::shard::Shard;
use crate::stretch::Frame;
use crate::trial::Trial;
use shadowgraph_charts::check::Record;
use shadowgraph_charts::model::{NodeCost, Point, Provenance};
use shadowgraph_core::facts::Facts;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::Keep;
use std::collections::HashMap;
use std::time::SystemTime;

/// Frames below this time, milliseconds, are timed several times a round.
const SHORT_MILLIS: f64 = 5.0;
/// After this time in its rounds, milliseconds, a variant is timed no more, once it has [`FEWEST_ROUNDS`].
const MOST_MILLIS: f64 = 10_000.0;
/// What a median and a spread need at least.
const FEWEST_ROUNDS: usize = 3;

/// How to run a suite.
pub struct How<'a> {
    /// All passes.
    pub catalogue: &'a Catalogue,
    /// Where nodes run that are not pinned, if the suite does not say.
    pub backend: BackendChoice,
    /// Which part of the suite: of its scenes, so that all times of one are taken together; where there are fewer scenes than parts, of
    /// each scene's variants.
    pub shard: Shard,
    /// Names of the scenes to run; none: all.
    pub scenes: &'a [String],
    /// Tells what is done.
    pub bar: &'a Bar,
}

/// What variants can run on. One that does not exist is the failure of those that name it.
struct Machines {
    asked: Result<Machine, Problem>,
    cpu: Result<Machine, Problem>,
    wgpu: Result<Machine, Problem>,
}

impl Machines {
    /// Those that a variant is to run on.
    fn of(&self, suite: &Suite, variant: &Variant) -> Vec<&Result<Machine, Problem>> {
        let named = if variant.backends.is_empty() { &suite.backends } else { &variant.backends };
        let named = named.iter().map(|name| if *name == "cpu" { &self.cpu } else { &self.wgpu });
        let named: Vec<_> = named.collect();
        if named.is_empty() { vec![&self.asked] } else { named }
    }
}

/// One variant on one scene and backend.
struct Case<'a> {
    variant: &'a Variant,
    machine: Option<&'a Machine>,
    backend: Backend,
    /// What it is without answers and times.
    point: Point,
    /// Its plan with outputs kept, if there is one.
    plan: Option<Plan>,
    /// A number of what it is judged by.
    truth: String,
}

/// Runs what the store does not have yet, and returns the ids of all that this run is about.
///
/// # Errors
/// The store cannot be written. What a variant, a scene or a device reports becomes the failure of its points.
pub fn run(suite: &Suite, store: &mut Store, how: &How) -> Result<Vec<String>, Problems> {
    let machines = Machines {
        asked: Machine::new(how.backend),
        cpu: Machine::new(BackendChoice::Cpu),
        wgpu: Machine::new(BackendChoice::Wgpu),
    };
    let scenes = suite.scenes.iter().filter(|scene| how.scenes.is_empty() || how.scenes.contains(&scene.name));
    let scenes: Vec<&SceneEntry> = scenes.collect();
    let (scenes, how) = if scenes.len() >= how.shard.count {
        let own = scenes.into_iter().enumerate().filter(|(index, _)| how.shard.takes(*index)).map(|(_, scene)| scene);
        (own.collect::<Vec<_>>(), &How { shard: Shard::WHOLE, ..*how })
    } else {
        (scenes, how)
    };
    let mut ids = Vec::new();
    for (index, scene) in scenes.iter().enumerate() {
        let about = format!("scene {} of {}, {}", index + 1, scenes.len(), scene.name);
        ids.extend(run_scene(suite, scene, &machines, store, how, &about)?);
    }
    Ok(ids)
}

fn run_scene(
    suite: &Suite,
    scene: &SceneEntry,
    machines: &Machines,
    store: &mut Store,
    how: &How,
    about: &str,
) -> Result<Vec<String>, Problems> {
    let variants =
        suite.variants.iter().filter(|variant| variant.only.is_empty() || variant.only.contains(&scene.name));
    let mut jobs = Jobs::new(scene);
    let mut cases = Vec::new();
    let all =
        variants.flat_map(|variant| machines.of(suite, variant).into_iter().map(move |machine| (variant, machine)));
    for (_, (variant, machine)) in all.enumerate().filter(|(index, _)| how.shard.takes(*index)) {
        cases.push(case(suite, scene, variant, machine, &mut jobs, how));
    }
    let earlier_count = store.show(&cases.iter().map(|case| &case.point).collect::<Vec<_>>())?;
    if earlier_count > 0 {
        let scene = &scene.name;
        let remark = format!(
            "{earlier_count} variants on {scene} are not what they were in an earlier run: its figures are kept, not shown"
        );
        store.remarks.push(Problem::new(Kind::BadValue, remark));
    }
    let is_open = |case: &Case| match store.answer(&case.point.id) {
        None => true,
        // Memory, a disk or a device that failed then may do now; what has no plan is asked by planning it.
        Some(known) if case.plan.is_some() => known.failure.is_some(),
        Some(known) => known.failure != case.point.failure,
    };
    let unanswered: Vec<usize> = (0..cases.len()).filter(|index| is_open(&cases[*index])).collect();
    let mut truths = Truths::default();
    for (done, index) in unanswered.iter().enumerate() {
        let case = &cases[*index];
        how.bar.set(&format!("{about}: judging {}", name(case)), done as u64, unanswered.len() as u64);
        let mut point = case.point.clone();
        if point.failure.is_none() {
            let asked = answer(suite, case, &mut jobs, &mut truths, how).and_then(|(answers, truth)| {
                let (errors, remarks) = errors_told(&answers, &truth)?;
                let told = remarks.into_iter().map(|remark| Problem { node: Some(name(case)), ..remark });
                store.remarks.extend(told);
                point.pictures = pictures::write(store.folder(), &point, &case.truth, &answers, &truth)?;
                // Figures that no chart takes are a fault of the variant, and stop no other.
                Answer(Point { errors: errors.clone(), ..point.clone() }).check()?;
                point.errors = errors;
                Ok(())
            });
            if let Err(problems) = asked {
                point.failure = Some(problems.to_string());
            }
        }
        // What fails as it did is told once.
        if point.failure.is_none() || store.answer(&point.id).map(|known| &known.failure) != Some(&point.failure) {
            store.add_answer(point)?;
        }
    }
    time(suite, &cases, &mut jobs, store, how, about)?;
    Ok(cases.into_iter().map(|case| case.point.id).collect())
}

/// Times what has an answer, round after round.
fn time(
    suite: &Suite,
    cases: &[Case],
    jobs: &mut Jobs,
    store: &mut Store,
    how: &How,
    about: &str,
) -> Result<(), Problems> {
    let failed = |id: &str, store: &Store| store.answer(id).is_some_and(|point| point.failure.is_some());
    let mut done: HashMap<String, Vec<f64>> = HashMap::new();
    for round in &store.rounds {
        done.entry(round.variant().to_string()).or_default().push(round.millis);
    }
    let is_enough = |millis: Option<&Vec<f64>>| {
        millis.is_some_and(|millis| millis.len() >= FEWEST_ROUNDS && millis.iter().sum::<f64>() > MOST_MILLIS)
    };
    let total = u64::from(suite.rounds) * cases.len() as u64;
    for round in 0..suite.rounds as usize {
        for place in order(cases.len(), round) {
            let case = &cases[place];
            let at = round as u64 * cases.len() as u64 + place as u64;
            how.bar.set(&format!("{about}: round {} of {}", round + 1, suite.rounds), at, total);
            let (id, Some(plan), Some(machine)) = (&case.point.id, &case.plan, case.machine) else { continue };
            let known = done.get(id);
            if failed(id, store) || known.is_some_and(|millis| millis.len() > round) || is_enough(known) {
                continue;
            }
            match timed(case, plan, machine, jobs, round) {
                Ok(round) => {
                    done.entry(id.clone()).or_default().push(round.millis);
                    store.add_round(round)?;
                }
                Err(problems) => {
                    let known = store.answer(id).cloned();
                    store.add_answer(Point {
                        failure: Some(problems.to_string()),
                        ..known.unwrap_or(case.point.clone())
                    })?;
                }
            }
        }
    }
    Ok(())
}

/// One round of one variant: a frame untimed, then one, or several if they are short, of which the median counts.
fn timed(case: &Case, plan: &Plan, machine: &Machine, jobs: &mut Jobs, round: usize) -> Result<Round, Problems> {
    let job = jobs.get(case.variant.light_samples)?;
    let options = shadowgraph_wgpu::Options::default();
    let mut trial = Trial::new(machine, plan, &job, &[], &options, &|_, _, _| {})?;
    let mut frame = trial.frame(false)?;
    let mut millis = vec![frame.millis];
    if frame.millis < SHORT_MILLIS {
        for _ in 0..4 {
            frame = trial.frame(false)?;
            millis.push(frame.millis);
        }
    }
    if case.backend == Backend::Wgpu {
        frame = trial.frame(true)?;
    }
    let millis = crate::outcome::Spread::of(&millis).median;
    Ok(Round { id: format!("{}#{round}", case.point.id), millis, nodes: node_costs(plan, &frame) })
}

fn node_costs(plan: &Plan, frame: &Frame) -> Vec<NodeCost> {
    let cost = |(node, ran): (&shadowgraph_core::plan::Node, &Option<crate::stretch::Ran>)| {
        let ran = ran.as_ref()?;
        let counters = node.pass.counters.iter().map(|counter| counter.name.to_string());
        Some(NodeCost {
            node: node.id.clone(),
            stage: node.pass.stage.name.into(),
            pass: node.pass.name.into(),
            millis: ran.millis?,
            bytes: ran.bytes as u64,
            counts: counters.zip(ran.counts.iter().copied()).collect(),
        })
    };
    plan.nodes.iter().zip(&frame.nodes).filter_map(cost).collect()
}

/// Places 0 to `count` in an order that differs from round to round.
fn order(count: usize, round: usize) -> Vec<usize> {
    let mut places: Vec<usize> = (0..count).collect();
    let mut coin = fastrand::Rng::with_seed(round as u64);
    coin.shuffle(&mut places);
    places
}

/// Runs a variant on the scene's view-samples, and the truth about them if it is not known yet.
fn answer(
    suite: &Suite,
    case: &Case,
    jobs: &mut Jobs,
    truths: &mut Truths,
    how: &How,
) -> Result<(Answers, Truth), Problems> {
    let samples = case.variant.light_samples;
    let grey = truths.reference(suite.reference, jobs, how)?;
    let bits = truths.about(samples, jobs, how)?;
    let job = jobs.get(samples)?.importing(truths.view_samples(jobs, how)?);
    let keep = Keep::AllLivePorts;
    let plan = graph_choice::plan(&case.variant.choice, how.catalogue, Some(&job.facts), case.backend, keep)?;
    let Some(machine) = case.machine else { unreachable!("a case without a machine has failed before") };
    let outcome = machine.run(&plan, &job, 1, &|_, _, _| {})?;
    Ok((Answers::of(&plan, &outcome, &job)?, Truth { bits: Some(bits), grey }))
}

fn name(case: &Case) -> String {
    let (graph, label) = (&case.point.graph, &case.point.label);
    if graph == label { graph.clone() } else { format!("{graph} {label}") }
}

/// Plans a variant and says what it is; what is wrong with it becomes its failure.
fn case<'a>(
    suite: &Suite,
    scene: &SceneEntry,
    variant: &'a Variant,
    machine: &'a Result<Machine, Problem>,
    jobs: &mut Jobs,
    how: &How,
) -> Case<'a> {
    let backend = machine.as_ref().map_or(Backend::Wgpu, |machine| machine.default_backend);
    let mut point = Point {
        suite: suite.name.clone(),
        scene: scene.name.clone(),
        view: scene.choice.view.clone().unwrap_or_default(),
        graph: variant.graph_name(),
        choices: variant.choices.clone(),
        // One point is no curve.
        quality_axis: variant.quality.clone().filter(|axis| variant.choices.iter().any(|(known, _)| known == axis)),
        label: variant.label(),
        backend: if backend == Backend::Cpu { "cpu".into() } else { "wgpu".into() },
        light_samples: variant.light_samples as usize,
        part: if how.shard.count > 1 { format!("{}/{}", how.shard.index, how.shard.count) } else { String::new() },
        ..Point::default()
    };
    if let Ok(job) = jobs.get(variant.light_samples) {
        (point.size, point.view) = (job.image, job.camera.name);
    }
    let planned = jobs.get(variant.light_samples).and_then(|job| {
        // What a light is shows only when it has more than one sample; without extent, they all are one.
        let light = jobs.get(suite.reference.min(MOST_OF_SET))?;
        let is_point = light.facts.light_is_point || !shadowgraph_scenes::lights::has_extent(&light.light);
        let facts = Facts { light_is_point: is_point, ..light.facts };
        if let Some(why) = variant.ruled_out(&facts) {
            return Err(Problem::new(Kind::Unsupported, format!("not tried: {why}")).into());
        }
        let keep = Keep::OutputsOnly;
        let plan = graph_choice::plan(&variant.choice, how.catalogue, Some(&job.facts), backend, keep)?;
        let truth = truth_number(variant.light_samples, suite.reference, jobs, how)?;
        Ok((job, plan, truth, machine.as_ref().map_err(Clone::clone)?))
    });
    let mut number = Number::default();
    number.text(&format!("{} {} {} {}", point.suite, point.scene, point.graph, point.label));
    number.text(&format!("{} {} {}", point.backend, suite.reference, scene.choice.size));
    let mut judged_by = Number::default();
    let plan = match planned {
        Ok((job, plan, truth, machine)) => {
            let mut graph = Number::default();
            take_plan(&mut graph, &plan);
            judged_by = truth;
            point.left_out = plan.left_out.clone();
            let device = machine.record();
            point.provenance = Provenance {
                graph_hash: graph.hex(),
                scene_hash: jobs.number(variant.light_samples, &job).hex(),
                program_version: env!("CARGO_PKG_VERSION").into(),
                commit: env!("SHADOWGRAPH_COMMIT").into(),
                adapter: device.adapter,
                driver: device.driver,
                adapter_type: device.adapter_type,
                threads: device.threads,
                wgpu_version: WGPU_VERSION.into(),
                started: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            };
            number.text(&point.provenance.graph_hash);
            number.text(&point.provenance.scene_hash);
            number.text(&truth.hex());
            // Times of another machine are other figures.
            number.text(&format!("{} {}", point.provenance.adapter, point.provenance.driver));
            number.word(point.provenance.threads as u32);
            Some(plan)
        }
        Err(problems) => {
            point.failure = Some(problems.to_string());
            None
        }
    };
    point.id = number.hex();
    Case { variant, machine: machine.as_ref().ok(), backend, point, plan, truth: judged_by.hex() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_have_orders_of_their_own() {
        let [first, second] = [order(9, 0), order(9, 1)];
        assert_ne!(first, second);
        let mut sorted = first;
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..9));
    }
}
