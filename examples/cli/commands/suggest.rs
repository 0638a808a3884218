//! `shadowgraph suggest`.

use crate::args::SuggestArgs;
use crate::chart::points::points;
use crate::chart::run::{How, run};
use crate::chart::store::{Lock, Store};
use crate::chart::suite::{SceneEntry, Suite};
use crate::chart::variant::Variant;
use crate::job::Job;
use crate::report::{Bar, align_right, table};
use crate::shard::Shard;
use crate::suggest::{Bound, Suggestion, graph_text, suggest};
use crate::{compare::text::figure, usage_problem};
use shadowgraph_charts::metric::{METRICS, Metric};
use shadowgraph_charts::model::Point;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::nearest;
use std::path::Path;

/// Name of the user's scene in the records.
const SCENE: &str = "scene";

/// What to print, and whether anything meets the bound.
///
/// # Errors
/// What is wrong with suite, scene or flags; a chart without records of the scene.
pub fn text(catalogue: &Catalogue, args: &SuggestArgs) -> Result<(String, bool), Problems> {
    let (points, suite) = match &args.chart {
        Some(folder) => charted(folder, args)?,
        None => measured(catalogue, args)?,
    };
    let points = of_scene(&points, args)?;
    let metric = metric(args, &points)?;
    let bound = match (args.error, args.ms) {
        (Some(error), _) => Bound::Error(error),
        (None, Some(millis)) => Bound::Millis(millis),
        (None, None) => return Err(usage_problem("nothing is asked for").expected("--error or --ms").into()),
    };
    let found = suggest(&points, metric, bound);
    let graph = found.as_ref().zip(suite).and_then(|(found, suite)| {
        let is_it = |variant: &&Variant| {
            (variant.label(), &variant.choices) == (found.point.label.clone(), &found.point.choices)
        };
        let variant = suite.variants.iter().find(is_it)?;
        Some(graph_text(&variant.choice, variant.light_samples as usize))
    });
    if args.json {
        let nearest = found.is_none().then(|| best(&points, metric, bound));
        let value = serde_json::json!({
            "metric": metric.name, "bound": bound, "suggestion": found, "graph": graph, "nearest": nearest
        });
        return Ok((serde_json::to_string_pretty(&value).unwrap_or_default() + "\n", found.is_some()));
    }
    Ok((report(&points, metric, bound, found.as_ref(), graph), found.is_some()))
}

/// Measures the scene: in a folder of its own, or where an earlier run was killed.
fn measured(catalogue: &Catalogue, args: &SuggestArgs) -> Result<(Vec<Point>, Option<Suite>), Problems> {
    let mut suite = Suite::load(args.suite.as_deref().unwrap_or("suggest"), None)?;
    // A scene that cannot be loaded is one problem, not one of each variant.
    Job::load(&args.scene)?;
    suite.size = args.scene.size.clone();
    suite.scenes = vec![SceneEntry { name: SCENE.into(), choice: args.scene.clone() }];
    for variant in &mut suite.variants {
        variant.only.clear();
    }
    let temporary;
    let folder = match &args.out {
        Some(folder) => folder.as_path(),
        None => {
            temporary = tempfile::tempdir().map_err(|error| usage_problem(error.to_string()))?;
            temporary.path()
        }
    };
    let _lock = Lock::take(folder)?;
    let mut store = Store::open(folder)?;
    let bar = Bar::new(args.quiet);
    let how = How { catalogue, backend: args.backend, shard: Shard::WHOLE, scenes: &[], bar: &bar };
    let ids = run(&suite, &mut store, &how)?;
    // The folder may hold other suites' figures.
    let points = points(&store)?.into_iter().filter(|point| ids.contains(&point.id)).collect();
    Ok((points, Some(suite)))
}

/// Takes the figures of a chart run, and the suite that says what its variants are, where that is known.
fn charted(folder: &Path, args: &SuggestArgs) -> Result<(Vec<Point>, Option<Suite>), Problems> {
    let store = Store::look(folder)?;
    let points = points(&store)?;
    let of_chart = points.first().map(|point| point.suite.as_str());
    let suite = match (&args.suite, of_chart.filter(|name| Suite::is_builtin(name))) {
        (Some(name), _) => Some(Suite::load(name, None)?),
        (None, Some(name)) => Some(Suite::load(name, None)?),
        (None, None) => None,
    };
    Ok((points, suite))
}

/// Points of the scene asked for; the only one where the chart has one.
fn of_scene<'a>(points: &'a [Point], args: &SuggestArgs) -> Result<Vec<&'a Point>, Problem> {
    let mut scenes: Vec<&str> = points.iter().map(|point| point.scene.as_str()).collect();
    scenes.sort_unstable();
    scenes.dedup();
    let wanted = match (args.on.as_deref(), scenes.as_slice()) {
        (Some(name), _) => name,
        (None, [one]) => one,
        (None, _) => {
            return Err(usage_problem("the chart has several scenes, or none")
                .expected(format!("--on and one of {}", scenes.join(", "))));
        }
    };
    let of: Vec<&Point> = points.iter().filter(|point| point.scene == wanted).collect();
    if of.is_empty() {
        let near = nearest(wanted, scenes.iter().copied()).map(|near| format!("did you mean {near}?"));
        return Err(Problem::new(Kind::UnknownName, "the chart has no such scene")
            .found(wanted)
            .remedy(near.unwrap_or_else(|| format!("scenes are {}", scenes.join(", ")))));
    }
    Ok(of)
}

fn metric(args: &SuggestArgs, points: &[&Point]) -> Result<&'static Metric, Problem> {
    let has_penumbra = points.iter().any(|point| point.errors.rmse_penumbra.is_some());
    let name = args.metric.as_deref().unwrap_or(if has_penumbra { "rmse_penumbra" } else { "wrong_bit_share" });
    Metric::named(name).ok_or_else(|| {
        let known: Vec<&str> = METRICS.iter().map(|metric| metric.name).collect();
        usage_problem("--metric names no error").expected(known.join(", ")).found(name)
    })
}

fn report(
    points: &[&Point],
    metric: &Metric,
    bound: Bound,
    found: Option<&Suggestion>,
    graph: Option<String>,
) -> String {
    let mut text = String::new();
    let mut rows = table(&["variant", "ms", "interval", metric.title]);
    let mut sorted: Vec<&&Point> = points.iter().filter(|point| point.failure.is_none()).collect();
    let millis = |point: &Point| point.millis.map_or(f64::INFINITY, |millis| millis.median);
    sorted.sort_by(|a, b| millis(a).total_cmp(&millis(b)));
    for point in sorted {
        let Some(time) = point.millis else { continue };
        let interval = format!("{:.2} .. {:.2}", time.low, time.high);
        rows.add_row([point.label.clone(), format!("{:.2}", time.median), interval, figure(metric.of(&point.errors))]);
    }
    align_right(&mut rows, &[1, 2, 3]);
    text += &format!("{rows}\n");
    for point in points {
        if let Some(failure) = &point.failure {
            text += &format!("{}: {failure}\n", point.label);
        }
    }
    let asked = match bound {
        Bound::Error(error) => format!("{} of at most {}", metric.title, figure(Some(error))),
        Bound::Millis(millis) => format!("at most {millis} ms a frame"),
    };
    let Some(found) = found else {
        return text + &format!("\nNothing meets {asked}. {}\n", best(points, metric, bound));
    };
    let time = found.point.millis.map_or(0.0, |millis| millis.median);
    text += &format!("\n{asked}: use {}, {time:.2} ms, error {}\n", found.point.label, figure(Some(found.error)));
    for other in &found.as_fast {
        text += &format!("  {} cannot be told from it by time\n", other.label);
    }
    text += "\n";
    text + &graph.unwrap_or_else(|| {
        "no suite here has this variant, so there is no graph to show: name its file by --suite\n".into()
    })
}

/// What comes nearest to a bound that nothing meets.
fn best(points: &[&Point], metric: &Metric, bound: Bound) -> String {
    let measured = points.iter().filter(|point| point.failure.is_none());
    let figure_of = |point: &&&Point| match bound {
        Bound::Error(_) => metric.of(&point.errors),
        Bound::Millis(_) => point.millis.map(|millis| millis.high),
    };
    let figures = measured.filter_map(|point| Some((figure_of(&point)?, point)));
    match figures.min_by(|(a, _), (b, _)| a.total_cmp(b)) {
        None => "Nothing was measured.".into(),
        Some((error, point)) if matches!(bound, Bound::Error(_)) => {
            format!("The least error is {}, of {}.", figure(Some(error)), point.label)
        }
        Some((millis, point)) => format!("The fastest is {}, up to {millis:.2} ms.", point.label),
    }
}
