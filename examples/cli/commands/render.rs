//! `shadowgraph render`.

use crate::args::RenderArgs;
use crate::converged::converged;
use crate::engine::Machine;
use crate::frames::Frames;
use crate::job::Job;
use crate::record::RunRecord;
use crate::report::{Bar, run_text};
use crate::{dump, file_problem, graph_choice, picture, usage_problem};
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::Keep;

/// Runs the graph, writes what was asked for, and returns what to print.
///
/// # Errors
/// What is wrong with scene, graph or flags; what a node reports.
pub fn text(catalogue: &Catalogue, args: &RenderArgs) -> Result<String, Problems> {
    let mut job = Job::load(&args.scene.for_graph(graph_choice::light_samples(&args.graph)?))?;
    if job.sets.len() > 1 {
        let one_set = [("--dump", args.dump.is_some()), ("--light-sets", args.light_sets.is_some())];
        if let Some((flag, _)) = one_set.iter().find(|(_, given)| *given) {
            return Err(usage_problem(format!(
                "{flag} is of one sample set, but jittered pixels have sets of their own"
            ))
            .remedy(format!("use {flag} with --jitter none"))
            .into());
        }
    }
    let mut machine = Machine::new(args.run.backend)?.in_ranges(args.run.ranges);
    let keep = if args.dump.is_some() { Keep::AllLivePorts } else { Keep::OutputsOnly };
    let plan = graph_choice::plan(&args.graph, catalogue, Some(&job.facts), machine.default_backend, keep)?;
    machine.ready_for(&plan)?;
    let bar = Bar::new(args.run.quiet);
    let progress = |node: &str, done, total| bar.set(node, done, total);
    let outcome = match (args.light_sets, args.frames) {
        (None, None) => machine.run(&plan, &job, args.run.repeat, &progress)?,
        (None, Some(frames)) => {
            let mut accumulated = Frames::new(&plan);
            for frame in 0..frames {
                let named = |node: &str, done, total| progress(&format!("frame {}: {node}", frame + 1), done, total);
                accumulated.add(machine.run(&plan, &job.in_frame(frame)?, 1, &named)?, job.standing());
            }
            let samples = job.light_samples_count();
            job.notes.push(format!("a mean over {frames} frames, each with {samples} light samples of its own"));
            accumulated.finish()
        }
        (Some(sets), _) => {
            let outcome = converged(&machine, &plan, &job, sets as usize, &progress)?;
            job.notes.push(format!(
                "a mean over {sets} disjoint sets of {} light samples, one run each: {} in all",
                job.light_samples_count(),
                sets as usize * job.light_samples_count()
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
        let dump::Written { arrays_count, left_out } = dump::write(folder, &plan, &job.inputs(), &outcome)?;
        wrote.push(format!("wrote {arrays_count} arrays to {}", folder.display()));
        if !left_out.is_empty() {
            let left_out = left_out.join(", ");
            wrote.push(format!(
                "left out, as every range of view-samples has its own (--ranges 1 keeps one): {left_out}"
            ));
        }
    }
    if !args.run.json && !wrote.is_empty() {
        text.push_str(&(wrote.join("\n") + "\n"));
    }
    Ok(text)
}
