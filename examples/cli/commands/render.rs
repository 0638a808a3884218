//! `shadowgraph render`.

use crate::args::RenderArgs;
use crate::converged::converged;
use crate::engine::Machine;
use crate::job::Job;
use crate::record::RunRecord;
use crate::report::{Bar, run_text};
use crate::{dump, file_problem, graph_choice, picture};
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::Keep;

/// Runs the graph, writes what was asked for, and returns what to print.
///
/// # Errors
/// What is wrong with scene, graph or flags; what a node reports.
pub fn text(catalogue: &Catalogue, args: &RenderArgs) -> Result<String, Problems> {
    let mut job = Job::load(&args.scene.for_graph(graph_choice::light_samples(&args.graph)?))?;
    let mut machine = Machine::new(args.run.backend)?.in_ranges(args.run.ranges);
    let keep = if args.dump.is_some() { Keep::AllLivePorts } else { Keep::OutputsOnly };
    let plan = graph_choice::plan(&args.graph, catalogue, Some(&job.facts), machine.default_backend, keep)?;
    machine.ready_for(&plan)?;
    let bar = Bar::new(args.run.quiet);
    let progress = |node: &str, done, total| bar.set(node, done, total);
    let outcome = match args.light_sets {
        None => machine.run(&plan, &job, args.run.repeat, &progress)?,
        Some(sets) => {
            let outcome = converged(&machine, &plan, &job, sets as usize, &progress)?;
            job.notes.push(format!(
                "a mean over {sets} disjoint sets of {} light samples, one run each: {} in all",
                job.samples.len(),
                sets as usize * job.samples.len()
            ));
            outcome
        }
    };
    drop(bar);
    let record = RunRecord::new(&plan, &job, machine.record(), &outcome);
    let mut text = if args.run.json {
        serde_json::to_string_pretty(&record).unwrap_or_default() + "\n"
    } else {
        run_text(&record)
    };
    let mut wrote = Vec::new();
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|error| file_problem(folder, &error))?;
        let slot = plan.outputs.iter().find(|(name, _)| name == "image").map(|(_, slot)| *slot);
        let Some(image) = slot.and_then(|slot| outcome.values.try_get(slot)) else {
            return Err(Problem::new(Kind::Missing, "the graph has no output named image, so there is no picture")
                .remedy("add `\"image\": \"shade.image\"` to its outputs, or use --dump")
                .into());
        };
        let (png, exr) = (folder.join("image.png"), folder.join("image.exr"));
        picture::write_png(&png, image)?;
        picture::write_exr(&exr, image)?;
        wrote.push(format!("wrote {} and {}", png.display(), exr.display()));
    }
    if let Some(folder) = &args.dump {
        if job.sets.len() > 1 {
            return Err(crate::usage_problem("a dump holds one sample set, but pixels have sets of their own")
                .remedy("use --dump with --jitter none")
                .into());
        }
        let count = dump::write(folder, &plan, &job.inputs(), &outcome)?;
        wrote.push(format!("wrote {count} arrays to {}", folder.display()));
    }
    if !args.run.json && !wrote.is_empty() {
        text.push_str(&(wrote.join("\n") + "\n"));
    }
    Ok(text)
}
