//! `shadowgraph check`: every mistake of graph files at once; with `--invariance` whether their values hang on what must not matter.

use crate::args::{CheckArgs, GraphChoice};
use crate::engine::Machine;
use crate::graph_choice::{self, inputs, load_graph};
use crate::invariance::{self, Plans, Report, Settings};
use crate::job::Job;
use crate::report::Bar;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::{Keep, Overrides};

/// What to print, and whether all graphs are right.
///
/// # Errors
/// With `--invariance`: as [`invariance::check`], and what is wrong with graphs, scene or flags.
pub fn text(catalogue: &Catalogue, args: &CheckArgs) -> Result<(String, bool), Problems> {
    if args.invariance {
        return invariance_text(catalogue, args);
    }
    Ok(mistakes(catalogue, args))
}

fn invariance_text(catalogue: &Catalogue, args: &CheckArgs) -> Result<(String, bool), Problems> {
    let settings = Settings { orders: args.orders, frames: args.frames, ranges: args.ranges };
    let bar = Bar::new(args.quiet);
    let one = |graph: &String| -> Result<Report, Problems> {
        let (swap, set, on) = (args.swap.clone(), args.set.clone(), args.on.clone());
        let choice = GraphChoice { graph: graph.clone(), swap, set, on, no_alias: false };
        let job = Job::load(&args.scene.for_graph(graph_choice::light_samples(&choice)?))?;
        let mut machine = Machine::new(args.backend)?;
        let plan = |keep| graph_choice::plan(&choice, catalogue, Some(&job.facts), machine.default_backend, keep);
        let (kept, shared) = (plan(Keep::AllLivePorts)?, plan(Keep::OutputsOnly)?);
        machine.ready_for(&kept)?;
        let progress = |what: &str, done, total| bar.set(what, done, total);
        let plans = Plans { kept: &kept, shared: &shared };
        Ok(invariance::check(&machine, plans, &job, &settings, &progress)?)
    };
    let reports = args.graphs.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    drop(bar);
    let text = match args.json {
        true => serde_json::to_string_pretty(&reports).unwrap_or_default() + "\n",
        false => reports.iter().map(invariance::text::text).collect::<Vec<_>>().join("\n"),
    };
    Ok((text, reports.iter().all(Report::is_invariant)))
}

fn mistakes(catalogue: &Catalogue, args: &CheckArgs) -> (String, bool) {
    let mut all: Vec<Problem> = Vec::new();
    let mut text = String::new();
    for name in &args.graphs {
        match problems_of(catalogue, name) {
            Ok(line) => text.push_str(&line),
            Err(Problems(problems)) => {
                text.push_str(&format!(
                    "{}\n{name}: {} problem{}\n",
                    Problems(problems.clone()),
                    problems.len(),
                    if problems.len() == 1 { "" } else { "s" }
                ));
                all.extend(problems);
            }
        }
    }
    let is_right = all.is_empty();
    if args.json {
        text = serde_json::to_string_pretty(&all).unwrap_or_default();
        text.push('\n');
    }
    (text, is_right)
}

/// Right means right on some backend: a graph of passes that only one backend has is no mistake.
fn problems_of(catalogue: &Catalogue, name: &str) -> Result<String, Problems> {
    let graph = load_graph(name)?;
    let on = |default_backend: Backend| {
        let overrides = Overrides { default_backend, ..Overrides::default() };
        shadowgraph_graph::plan(&graph, catalogue, &inputs(true), None, &overrides)
    };
    let backend_only = |problems: &Problems| problems.0.iter().all(|problem| problem.kind == Kind::Unsupported);
    let (plan, where_text) = match on(Backend::Cpu) {
        Err(problems) if backend_only(&problems) => (on(Backend::Wgpu).map_err(|_| problems)?, ", on wgpu only"),
        other => (other?, ""),
    };
    Ok(format!(
        "{name}: right{where_text}; {} nodes run, {} left out without a scene\n",
        plan.nodes.len(),
        plan.left_out.len()
    ))
}
