//! `shadowgraph suggest`.

use crate::args::SuggestArgs;
use crate::chart::points::points;
use crate::chart::run::{How, run};
use crate::chart::store::{Lock, Store};
use crate::chart::suite::{SceneEntry, Suite};
use crate::report::{Bar, align_right, table};
use crate::suggest::{Bound, Suggestion, graph_text, suggest};
use crate::{compare::text::figure, usage_problem};
use shadowgraph_charts::metric::{METRICS, Metric};
use shadowgraph_charts::model::Point;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::nearest;

/// Name of the user's scene in the records.
const SCENE: &str = "scene";

/// What to print, and whether anything meets the bound.
///
/// # Errors
/// What is wrong with suite, scene or flags; a chart without records of the scene.
pub fn text(catalogue: &Catalogue, args: &SuggestArgs) -> Result<(String, bool), Problems> {
    let mut suite = Suite::load(&args.suite, None)?;
    let temporary;
    let folder = match (&args.chart, &args.out) {
        (Some(folder), _) | (None, Some(folder)) => folder.clone(),
        (None, None) => {
            temporary = tempfile::tempdir().map_err(|error| usage_problem(error.to_string()))?;
            temporary.path().to_path_buf()
        }
    };
    let store = match &args.chart {
        Some(folder) => Store::open(folder)?,
        None => {
            suite.size = args.scene.size.clone();
            suite.scenes = vec![SceneEntry { name: SCENE.into(), choice: args.scene.clone() }];
            let _lock = Lock::take(&folder)?;
            let mut store = Store::open(&folder)?;
            let bar = Bar::new(args.quiet);
            let how = How { catalogue, backend: args.backend, shard: [0, 1], scenes: &[], bar: &bar };
            run(&suite, &mut store, &how)?;
            store
        }
    };
    let points = points(&store)?;
    let points = of_scene(&points, args)?;
    let metric = metric(args, &points)?;
    let bound = match (args.error, args.ms) {
        (Some(error), _) => Bound::Error(error),
        (None, Some(millis)) => Bound::Millis(millis),
        (None, None) => return Err(usage_problem("nothing is asked for").expected("--error or --ms").into()),
    };
    let found = suggest(&points, metric, bound);
    let graph = found.as_ref().and_then(|found| {
        let variant = suite.variants.iter().find(|variant| variant.label() == found.point.label)?;
        Some(graph_text(&variant.choice, variant.light_samples as usize))
    });
    if args.json {
        let value = serde_json::json!({ "metric": metric.name, "bound": bound, "suggestion": found, "graph": graph });
        return Ok((serde_json::to_string_pretty(&value).unwrap_or_default() + "\n", found.is_some()));
    }
    Ok((report(&points, metric, bound, found.as_ref(), graph), found.is_some()))
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
        let best = points.iter().filter_map(|point| metric.of(&point.errors)).min_by(f64::total_cmp);
        return text + &format!("\nNothing meets {asked}. The least error measured is {}.\n", figure(best));
    };
    let time = found.point.millis.map_or(0.0, |millis| millis.median);
    text += &format!("\n{asked}: use {}, {time:.2} ms, error {}\n", found.point.label, figure(Some(found.error)));
    for other in &found.as_fast {
        text += &format!("  {} cannot be told from it by time\n", other.label);
    }
    text += "\n";
    text + &graph.unwrap_or_else(|| "the suite has no variant of that name, so there is no graph to show\n".into())
}
