//! `shadowgraph compare`.

use crate::args::CompareArgs;
use crate::compare::bisect::bisect;
use crate::compare::picture::write_difference;
use crate::compare::side::Side;
use crate::compare::text::{bisect_text, text as report_text};
use crate::compare::{Report, Wanted, compare};
use crate::engine::Machine;
use crate::file_problem;
use crate::report::Bar;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Kind, Problems};
use shadowgraph_measure::paired::Settings;
use shadowgraph_wgpu::Session;
use std::path::Path;

/// What to print, and whether every value differs only as its contract allows.
///
/// # Errors
/// What is wrong with scene, graphs or flags; what a node reports.
pub fn text(catalogue: &Catalogue, args: &CompareArgs) -> Result<(String, bool), Problems> {
    let mut machine = Machine::new(args.backend)?;
    let a = Side::new(args.choice_a(), &args.scene, catalogue, &mut machine)?;
    let bar = Bar::new(args.quiet);
    let progress = |node: &str, done, total| bar.set(node, done, total);
    if args.bisect {
        machine.open(Session::shared()?);
        let found = bisect(&a, &machine, &progress)?;
        drop(bar);
        let text = if args.json { json(&found) } else { bisect_text(&found) };
        return Ok((text, found.node.is_none()));
    }
    let b = Side::new(args.choice_b(), &args.scene, catalogue, &mut machine)?;
    let settings = Settings {
        threshold: args.threshold,
        budget_millis: Some(args.seconds * 1e3),
        most_blocks: args.blocks,
        pilot_blocks: Settings::default().pilot_blocks.min(args.blocks),
        seed: args.seed,
        ..Settings::default()
    };
    let wanted = Wanted {
        timing: (!args.no_timing).then_some(settings),
        truth: (!args.no_truth).then_some(args.truth.as_deref()),
        attribute: args.attribute,
    };
    let report = compare(&a, &b, &wanted, catalogue, &machine, &progress).map_err(|problems| judged(args, problems))?;
    drop(bar);
    let mut text = if args.json { json(&report) } else { report_text(&report) };
    if let Some(folder) = &args.out {
        let wrote = write(folder, &report)?;
        if !args.json {
            text += &wrote;
        }
    }
    Ok((text, report.is_as_allowed()))
}

/// A graph that makes nothing to judge can be compared all the same.
fn judged(args: &CompareArgs, mut problems: Problems) -> Problems {
    for problem in problems.0.iter_mut().filter(|problem| problem.kind == Kind::Missing && !args.no_truth) {
        problem.remedy.get_or_insert_with(|| "compare it with --no-truth".into());
    }
    problems
}

fn json(report: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(report).unwrap_or_default() + "\n"
}

fn write(folder: &Path, report: &Report) -> Result<String, Problems> {
    std::fs::create_dir_all(folder).map_err(|error| file_problem(folder, &error))?;
    let (Some([a, b]), Some([true_a, true_b])) = (&report.answers, &report.truths) else {
        return Ok("no pictures: nothing was judged (--no-truth)\n".into());
    };
    let mut wrote = Vec::new();
    for (name, test, truth) in [("error-a.png", a, true_a), ("error-b.png", b, true_b), ("difference.png", b, a)] {
        if name == "difference.png" && test.pixel != truth.pixel {
            wrote.push("no difference.png: A and B have other view-samples".to_string());
            continue;
        }
        let path = folder.join(name);
        write_difference(&path, test, truth)?;
        wrote.push(format!("wrote {}", path.display()));
    }
    wrote.push(format!("colours: {}", shadowgraph_charts::error_map::DOC));
    Ok(wrote.join("\n") + "\n")
}
