//! Two graphs on the same inputs: what differs between them, where their values begin to differ, which is wrong and by how much,
//! which is faster and how certain that is.
//!
//! For correctness both run once with every value kept, and B takes over what A made wherever a node, its parameters, its backend
//! and everything upstream are the same: so an unspecified order in a list is no difference, and view-samples are shared. For
//! timing each runs as a whole by itself ([`timing`]).

pub mod bisect;
pub mod errors;
pub mod picture;
pub mod plans;
pub mod ports;
pub mod side;
pub mod text;
pub mod timing;

use crate::answers::{Answers, errors as errors_of};
use crate::engine::Machine;
use crate::record::DeviceRecord;
use crate::trial::Trial;
use errors::{Blame, Truths, attribute};
use plans::{Difference, differences, shared};
use ports::PortRow;
use serde::Serialize;
use shadowgraph_charts::model::Errors;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::Problems;
use shadowgraph_cpu::Progress;
use shadowgraph_graph::plan_id;
use shadowgraph_measure::paired::Settings;
use side::{Ran, Side};
use timing::Timing;

/// What to find out.
#[derive(Clone, Debug)]
pub struct Wanted<'a> {
    /// Times, if they are to be compared.
    pub timing: Option<Settings>,
    /// Errors, if they are to be judged; the truth's graph, or the fitting one.
    pub truth: Option<Option<&'a str>>,
    /// Whether B's error is traced to its nodes.
    pub attribute: bool,
}

/// All that a comparison says.
#[derive(Debug, Serialize)]
pub struct Report {
    /// A, as given, and the number of its resolved graph.
    pub a: [String; 2],
    /// B likewise.
    pub b: [String; 2],
    /// The scene.
    pub scene: String,
    /// Picture width and height, pixels.
    pub size: [usize; 2],
    /// Light samples of A and of B.
    pub light_samples: [usize; 2],
    /// Where it ran.
    pub device: DeviceRecord,
    /// In what the graphs differ.
    pub differences: Vec<Difference>,
    /// Nodes whose values B took over from A.
    pub shared: Vec<String>,
    /// Values of nodes that both have and that were run for each.
    pub ports: Vec<PortRow>,
    /// The first node where values begin to differ, in the order of B.
    pub first_difference: Option<String>,
    /// Light samples of the truth that visible fractions and pictures of both are judged by: the larger number of the two. Bits are
    /// judged by a truth of each side's own.
    pub truth_light_samples: Option<usize>,
    /// How wrong A and B are.
    pub errors: Option<[Errors; 2]>,
    /// What the nodes of B are to blame for, most first.
    pub blames: Vec<Blame>,
    /// Nodes of B of which no error is known: the truth has no values for them, or answers do not come from what they make.
    pub not_attributed: Vec<String>,
    /// Which is faster.
    pub timing: Option<Timing>,
    /// What answered, for pictures.
    #[serde(skip)]
    pub answers: Option<[Answers; 2]>,
    /// The truth about each, for pictures.
    #[serde(skip)]
    pub truths: Option<[Answers; 2]>,
}

impl Report {
    /// Whether no value differs other than its contract allows.
    pub fn is_as_allowed(&self) -> bool {
        !self.ports.iter().any(PortRow::is_fault)
    }
}

/// Compares two sides.
///
/// # Errors
/// What is wrong with the truth's graph or the settings; as [`Machine::run`].
pub fn compare(
    a: &Side,
    b: &Side,
    wanted: &Wanted,
    catalogue: &Catalogue,
    machine: &Machine,
    progress: &Progress,
) -> Result<Report, Problems> {
    let inputs = [a.job.inputs(), b.job.inputs()];
    let same_input = |name: &str| {
        let of = |inputs: &[(String, _)]| inputs.iter().position(|(input, _)| input == name);
        of(&inputs[0]).zip(of(&inputs[1])).is_some_and(|(at, bt)| inputs[0][at].1 == inputs[1][bt].1)
    };
    let shared = shared(&a.plan, &b.plan, same_input);
    let ran_a = Ran::new(machine, a, Vec::new(), |_| false, progress)?;
    let mut given = Vec::new();
    let mut taken = Vec::new();
    for (of_b, of_a) in &shared {
        let (of_b, of_a) = (&b.plan.nodes[*of_b], &a.plan.nodes[*of_a]);
        let outputs = of_b
            .outputs
            .iter()
            .map(|(port, slot)| Some((b.plan.slots[*slot].name.clone(), ran_a.output(&of_a.id, port)?.clone())));
        // A run in ranges of view-samples keeps no tables: such nodes run again.
        if let Some(outputs) = outputs.collect::<Option<Vec<_>>>() {
            given.extend(outputs);
            taken.push(of_b.id.clone());
        }
    }
    let ran_b = Ran::new(machine, b, given, |node| taken.contains(&node.id), progress)?;
    let ports = ports::compare((a, &ran_a), (b, &ran_b), &shared);
    let first_difference = ports.iter().find(|row| row.is_origin()).map(|row| row.node.clone());

    let mut report = Report {
        a: [a.choice.graph.clone(), plan_id(&a.plan)],
        b: [b.choice.graph.clone(), plan_id(&b.plan)],
        scene: b.job.scene_spec.clone(),
        size: b.job.image,
        light_samples: [a.job.light_samples_count(), b.job.light_samples_count()],
        device: machine.record(),
        differences: differences(&a.plan, &b.plan),
        shared: taken,
        ports,
        first_difference,
        truth_light_samples: None,
        errors: None,
        blames: Vec::new(),
        not_attributed: Vec::new(),
        timing: None,
        answers: None,
        truths: None,
    };
    if let Some(truth) = wanted.truth {
        let (answers_a, answers_b) = (ran_a.answers(a)?, ran_b.answers(b)?);
        let jobs = [&a.job, &b.job];
        let truths = Truths::new(truth, [&answers_a, &answers_b], jobs, catalogue, machine, progress)?;
        let [truth_a, truth_b] = truths.of_both();
        let errors_b = errors_of(&answers_b, &truth_b)?;
        if wanted.attribute {
            (report.blames, report.not_attributed) =
                attribute(b, &ran_b, &truths.own_b, &truth_b, &errors_b, machine, progress)?;
        }
        report.errors = Some([errors_of(&answers_a, &truth_a)?, errors_b]);
        report.truth_light_samples = Some(truth_b.grey.light_samples);
        report.truths = Some([truth_a.grey, truth_b.grey]);
        report.answers = Some([answers_a, answers_b]);
    }
    drop((ran_a, ran_b));
    if let Some(settings) = wanted.timing {
        let (plan_a, plan_b) = (a.timed_plan(catalogue, machine)?, b.timed_plan(catalogue, machine)?);
        let options = shadowgraph_wgpu::Options::default();
        let mut trial_a = Trial::new(machine, &plan_a, &a.job, &[], &options, progress)?;
        let mut trial_b = Trial::new(machine, &plan_b, &b.job, &[], &options, progress)?;
        let told = |done, most| progress("timing, in blocks", done, most);
        report.timing = Some(timing::time(&mut trial_a, &mut trial_b, settings, &told)?);
    }
    Ok(report)
}
