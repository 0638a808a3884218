//! `shadowgraph profile`.

use crate::args::ProfileArgs;
use crate::engine::Machine;
use crate::job::Job;
use crate::profile::{Settings, csv, profile, text as as_text, trace};
use crate::report::Bar;
use crate::{file_problem, graph_choice};
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Problem, Problems};
use shadowgraph_graph::Keep;
use std::path::Path;

/// Measures, writes what was asked for, and returns what to print.
///
/// # Errors
/// What is wrong with scene, graph or flags; what a node reports; a file that cannot be written.
pub fn text(catalogue: &Catalogue, args: &ProfileArgs) -> Result<String, Problems> {
    let job = Job::load(&args.scene.for_graph(graph_choice::light_samples(&args.graph)?))?;
    let mut machine = Machine::new(args.machine.backend)?.in_ranges(args.machine.ranges);
    let plan_for = |keep| graph_choice::plan(&args.graph, catalogue, Some(&job.facts), machine.default_backend, keep);
    let (plan, kept) = (plan_for(Keep::OutputsOnly)?, plan_for(Keep::AllLivePorts)?);
    machine.ready_for(&plan)?;
    let settings = Settings {
        frames: args.frames,
        warm_up: args.warm_up,
        alone: args.alone.unwrap_or(args.frames),
        timers: !args.no_timers,
        statistics: args.statistics,
    };
    let bar = Bar::new(args.machine.quiet);
    let profile = profile(&machine, &plan, &kept, &job, &settings, &|what, done, total| bar.set(what, done, total))?;
    drop(bar);
    let mut text = match args.machine.json {
        true => serde_json::to_string_pretty(&profile).unwrap_or_default() + "\n",
        false => as_text::text(&profile),
    };
    let mut write = |path: &Option<std::path::PathBuf>, content: &dyn Fn() -> String| -> Result<(), Problem> {
        let Some(path) = path else { return Ok(()) };
        write_file(path, &content())?;
        if !args.machine.json {
            text.push_str(&format!("wrote {}\n", path.display()));
        }
        Ok(())
    };
    write(&args.csv, &|| csv::text(&profile))?;
    write(&args.trace, &|| trace::text(&profile))?;
    Ok(text)
}

fn write_file(path: &Path, content: &str) -> Result<(), Problem> {
    std::fs::write(path, content).map_err(|error| file_problem(path, &error))
}
