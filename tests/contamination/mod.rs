//! No value may depend on the order of nodes, on what memory held before, on who shares it, on how often a frame ran, on threads, or on
//! the parts that view-samples run in: `check --invariance` over the built-in graphs, and faults planted for each of its checks.

mod planted;

use crate::bench::{job_lit, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::invariance::{Plans, Report, Settings, Verdict, check};
use shadowgraph::job::Job;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_graph::{Keep, Overrides, Source, builtin, load};

/// A trial for each graph on each backend, and the controls.
pub fn trials() -> Vec<Trial> {
    let on_both =
        ["hard", "hard_fused", "shadow_map", "pcf", "pcss", "multi_shadow_map", "soft", "soft_penumbra", "rays_soft"];
    let on = |graph: &'static str, choice| move || unchanged(graph, choice);
    let mut trials = Vec::new();
    for graph in on_both.into_iter().chain(["soft_shafts", "soft_silhouettes", "truth_soft"]) {
        trials.push(Trial::test(format!("contamination/{graph}/cpu"), on(graph, BackendChoice::Cpu)));
    }
    for graph in on_both.into_iter().chain(["hard_draw"]) {
        let run = on(graph, BackendChoice::Wgpu);
        trials.push(gpu::trial(format!("contamination/{graph}/wgpu"), move |_| run()));
    }
    trials.push(gpu::trial("contamination/memory_shared_wrongly_is_named".into(), |_| shared_wrongly()));
    trials.extend(planted::trials());
    trials
}

/// A small job: with light samples for soft graphs.
fn small_job(is_soft: bool) -> Job {
    let light: &[&str] = if is_soft { &["--light-samples", "20", "--light-radius", "0.5"] } else { &[] };
    job_lit("builtin:columns", "48x40", light)
}

fn unchanged(graph: &str, choice: BackendChoice) -> Result<(), Failed> {
    let job = small_job(graph.contains("soft") || graph == "multi_shadow_map" || graph == "pcss");
    let args = render_args(&[graph]).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let machine = Machine::new(choice).map_err(|problem| problem.to_string())?;
    let plan = |keep| {
        graph_choice::plan(&args, &catalogue, Some(&job.facts), machine.default_backend, keep)
            .map_err(|problems| problems.to_string())
    };
    let (kept, shared) = (plan(Keep::AllLivePorts)?, plan(Keep::OutputsOnly)?);
    let report = report(&machine, &kept, &shared, &job)?;
    if report.is_invariant() { Ok(()) } else { Err(shadowgraph::invariance::text::text(&report).into()) }
}

fn report(machine: &Machine, kept: &Plan, shared: &Plan, job: &Job) -> Result<Report, Failed> {
    check(machine, Plans { kept, shared }, job, &Settings::default(), &|_, _, _| {})
        .map_err(|problem| problem.to_string().into())
}

/// What all checks say of graph text `text` over `catalogue`, all on one backend.
fn report_of(catalogue: &Catalogue, text: &str, choice: BackendChoice) -> Result<Report, Failed> {
    let (machine, job) = (Machine::new(choice).map_err(|problem| problem.to_string())?, small_job(false));
    let source = Source { name: "planted.ron".into(), text: text.into() };
    let graph =
        load(source, &|name| Ok(builtin(name).unwrap_or_default().into())).map_err(|error| error.to_string())?;
    let plan = |keep| {
        let overrides = Overrides { keep, default_backend: machine.default_backend, ..Overrides::default() };
        shadowgraph_graph::plan(&graph, catalogue, &graph_choice::inputs(false), Some(&job.facts), &overrides)
            .map_err(|problems| problems.to_string())
    };
    report(&machine, &plan(Keep::AllLivePorts)?, &plan(Keep::OutputsOnly)?, &job)
}

/// Checks of a report that found a difference, without repetition, each with where it says that the difference begins.
fn found(report: &Report) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    for check in &report.checks {
        if let Verdict::Differs { ports } = &check.verdict {
            let begins = ports.iter().filter(|port| port.begins_here);
            let begins: Vec<String> = begins.map(|port| format!("{}.{}", port.node, port.port)).collect();
            let one = (check.check, begins.join(", "));
            if !found.contains(&one) {
                found.push(one);
            }
        }
    }
    found
}

/// Positions overwritten by list offsets: the node that reads them afterwards is named, and no other check minds.
fn shared_wrongly() -> Result<(), Failed> {
    let machine = Machine::new(BackendChoice::Wgpu).map_err(|problem| problem.to_string())?;
    let (job, args) = (small_job(false), render_args(&["hard"]).graph);
    let catalogue = shadowgraph_passes::catalogue();
    let plan = |keep| {
        graph_choice::plan(&args, &catalogue, Some(&job.facts), Backend::Wgpu, keep)
            .map_err(|problems| problems.to_string())
    };
    let (kept, mut wrong) = (plan(Keep::AllLivePorts)?, plan(Keep::OutputsOnly)?);
    let slot = |name: &str| wrong.slot(name).ok_or_else(|| Failed::from(format!("no slot {name}")));
    let (position, offset) = (slot("view_samples.position")?, slot("list_scan.offset")?);
    wrong.slots[position].alias = wrong.slots[offset].alias;
    let report = report(&machine, &kept, &wrong, &job)?;
    // Visibility is the first to read positions once offsets have been written over them.
    assert_eq!(found(&report), [("sharing", "visibility.mask".to_string())]);
    Ok(())
}
