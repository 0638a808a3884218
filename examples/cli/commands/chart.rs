//! `shadowgraph chart` and `shadowgraph merge`.

use crate::args::{ChartArgs, MergeArgs};
use crate::chart::run::{How, run};
use crate::chart::store::{Lock, Store, merge};
use crate::chart::suite::Suite;
use crate::chart::{points, store};
use crate::compare::text::figure;
use crate::report::{Bar, align_right, table};
use crate::shard::Shard;
use crate::usage_problem;
use shadowgraph_charts::model::Point;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::Problems;

/// Runs what is missing of a suite, and what to print.
///
/// # Errors
/// What is wrong with the suite; a file cannot be written.
pub fn text(catalogue: &Catalogue, args: &ChartArgs) -> Result<String, Problems> {
    let suite = Suite::load(&args.suite, args.scenes.as_deref())?;
    if suite.scenes.is_empty() {
        let problem = usage_problem("the suite has no scenes").found(&args.suite);
        return Err(problem.remedy("suggest runs it on a scene of your own").into());
    }
    let known: Vec<&str> = suite.scenes.iter().map(|scene| scene.name.as_str()).collect();
    if let Some(name) = args.scene.iter().find(|name| !known.contains(&name.as_str())) {
        let problem = usage_problem("--scene names no scene of the suite").expected(known.join(", ")).found(name);
        return Err(problem.into());
    }
    let shard = Shard::read(&args.shard)?;
    let _lock = Lock::take(&args.out)?;
    let mut store = Store::open(&args.out)?;
    tell(&mut store);
    if !args.page_only {
        let bar = Bar::new(args.quiet);
        let how = How { catalogue, backend: args.backend, shard, scenes: &args.scene, bar: &bar };
        run(&suite, &mut store, &how)?;
        drop(bar);
        tell(&mut store);
    }
    finish(&store, &format!("Shadowgraph: {}", suite.name), &suite.doc, args.json)
}

/// Prints what is worth telling and stops nothing.
fn tell(store: &mut Store) {
    for remark in store.remarks.drain(..) {
        eprintln!("{remark}");
    }
}

/// Makes one folder of several, and what to print.
///
/// # Errors
/// A folder that holds no records; a file cannot be written.
pub fn merge_text(args: &MergeArgs) -> Result<String, Problems> {
    let _lock = Lock::take(&args.out)?;
    let mut whole = Store::open(&args.out)?;
    let mut text = String::new();
    for part in &args.parts {
        let [answers, rounds] = merge(&mut whole, part)?;
        text += &format!("{}: {answers} answers, {rounds} timed rounds\n", part.display());
    }
    tell(&mut whole);
    let suite = whole.answers.first().map(|point| point.suite.clone()).unwrap_or_default();
    Ok(text + &finish(&whole, &format!("Shadowgraph: {suite}"), "", false)?)
}

fn finish(store: &Store, title: &str, about: &str, json: bool) -> Result<String, Problems> {
    let (wrote, remarks) = points::write(store, title, about)?;
    for remark in remarks {
        eprintln!("{remark}");
    }
    let points = points::points(store)?;
    if json {
        return Ok(serde_json::to_string_pretty(&points).unwrap_or_default() + "\n");
    }
    let mut text = table_text(&points);
    for path in wrote {
        text += &format!("wrote {}\n", path.display());
    }
    text += &format!("pictures in {}\n", store.folder().join(store::PICTURES).display());
    Ok(text)
}

fn table_text(points: &[Point]) -> String {
    let header =
        ["scene", "graph", "variant", "on", "ms", "interval", "wrong bits", "RMSE penumbra", "RMSE all", "FLIP"];
    let mut rows = table(&header);
    let mut failures = String::new();
    for point in points {
        if let Some(failure) = &point.failure {
            failures += &format!("{} {} {}: {failure}\n", point.scene, point.graph, point.label);
            continue;
        }
        let (median, interval) = match point.millis {
            Some(millis) => (format!("{:.2}", millis.median), format!("{:.2} .. {:.2}", millis.low, millis.high)),
            None => ("-".into(), "-".into()),
        };
        let errors = &point.errors;
        rows.add_row([
            point.scene.clone(),
            point.graph.clone(),
            point.label.clone(),
            point.backend.clone(),
            median,
            interval,
            figure(errors.wrong_bit_share),
            figure(errors.rmse_penumbra),
            figure(errors.rmse_all),
            figure(errors.flip_tonemapped),
        ]);
    }
    align_right(&mut rows, &[4, 5, 6, 7, 8, 9]);
    let mut text = format!("{rows}\n");
    if !failures.is_empty() {
        text += &format!("Not run:\n{failures}");
    }
    text
}
