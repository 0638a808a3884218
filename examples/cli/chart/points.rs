//! From what a run left on disk to points, and from points to the page and its files.

use super::store::{POINTS, Store};
use shadowgraph_charts::front::Front;
use shadowgraph_charts::lines::to_line;
use shadowgraph_charts::metric::Metric;
use shadowgraph_charts::model::{Interval, NodeCost, Point};
use shadowgraph_charts::page::{Options, charts};
use shadowgraph_charts::{csv, files};
use shadowgraph_core::problem::{Problem, Problems};
use shadowgraph_measure::pareto::{self, Measured};
use shadowgraph_measure::statistics::{self, median, order_interval};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Confidence of the intervals of medians.
const CONFIDENCE: f64 = 0.95;
/// Bytes of pictures that a page may hold.
const PICTURES_MAX_BYTES: usize = 12 << 20;
/// Errors that have SVG files of their own.
const SVG_METRICS: [&str; 3] = ["rmse_penumbra", "rmse_all", "wrong_bit_share"];

/// Every answer with its times: medians over rounds. An answer that is not timed yet is left out.
///
/// # Errors
/// A time that is not finite.
pub fn points(store: &Store) -> Result<Vec<Point>, Problem> {
    let mut points = Vec::new();
    for answer in store.shown() {
        let rounds: Vec<_> = store.rounds.iter().filter(|round| round.variant() == answer.id).collect();
        let millis: Vec<f64> = rounds.iter().map(|round| round.millis).collect();
        let mut point = answer.clone();
        if !millis.is_empty() {
            let by_order = order_interval(&millis, CONFIDENCE)?;
            // Too few rounds for an interval at that confidence: all that was seen.
            let seen = || statistics::Interval {
                low: millis.iter().copied().fold(f64::INFINITY, f64::min),
                high: millis.iter().copied().fold(0.0, f64::max),
            };
            let interval = by_order.unwrap_or_else(seen);
            point.millis = Some(Interval { median: median(&millis)?, low: interval.low, high: interval.high });
            point.runs_count = millis.len() as u32;
            point.nodes = nodes(rounds.iter().map(|round| round.nodes.as_slice()))?;
        }
        if point.failure.is_some() || point.millis.is_some() {
            points.push(point);
        }
    }
    Ok(points)
}

/// Medians of each node's time over rounds; sizes and counts of the last.
fn nodes<'a>(rounds: impl Iterator<Item = &'a [NodeCost]> + Clone) -> Result<Vec<NodeCost>, Problem> {
    let Some(last) = rounds.clone().last() else { return Ok(Vec::new()) };
    let of = |cost: &NodeCost| {
        let times = rounds.clone().flatten().filter(|other| other.node == cost.node).map(|other| other.millis);
        Ok(NodeCost { millis: median(&times.collect::<Vec<_>>())?, ..cost.clone() })
    };
    last.iter().map(of).collect()
}

/// The Pareto front with the intervals of time: a variant is dominated by the fastest that is at least as right.
pub fn front(points: &[&Point], metric: &Metric) -> Front {
    let figures: Vec<(&Point, pareto::Point)> = points
        .iter()
        .filter(|point| point.failure.is_none())
        .filter_map(|point| {
            let (millis, error) = (point.millis?, metric.of(&point.errors)?);
            let interval = statistics::Interval { low: millis.low, high: millis.high };
            let millis = Measured { value: millis.median, interval };
            Some((*point, pareto::Point { millis, error: Measured::exact(error) }))
        })
        .collect();
    let plain: Vec<pareto::Point> = figures.iter().map(|(_, figure)| *figure).collect();
    let Ok(standings) = pareto::standings(&plain) else { return shadowgraph_charts::front::front(points, metric) };
    let mut front = Front::default();
    let mut by_time: Vec<usize> = (0..figures.len()).collect();
    by_time.sort_by(|a, b| plain[*a].millis.value.total_cmp(&plain[*b].millis.value));
    for index in by_time {
        let id = figures[index].0.id.clone();
        match standings[index].dominated_by.iter().find(|by| standings[**by].on_front()) {
            Some(by) => front.dominated.push((id, figures[*by].0.id.clone())),
            None => front.on.push(id),
        }
    }
    front
}

/// Names the scenes whose times were not all taken together: on one machine, in the same rounds. Empty where there are none.
fn mixed(points: &[Point]) -> String {
    let mut together: BTreeMap<&str, BTreeSet<_>> = BTreeMap::new();
    for point in points.iter().filter(|point| point.failure.is_none()) {
        let of = &point.provenance;
        // Only what ran on an adapter names one.
        let adapter = (point.backend != "cpu").then_some((&of.adapter, &of.driver));
        together.entry(&point.scene).or_default().insert((&point.backend, adapter, of.threads, &point.part));
    }
    let is_mixed = |(_, sets): &(&&str, &BTreeSet<(&String, _, usize, &String)>)| {
        sets.iter().any(|a| sets.iter().any(|b| (a.0 == b.0 && a != b) || (a.2, a.3) != (b.2, b.3)))
    };
    let scenes: Vec<&str> = together.iter().filter(is_mixed).map(|(scene, _)| *scene).collect();
    match scenes.as_slice() {
        [] => String::new(),
        scenes => format!(
            "Not all times were taken together, but in parts or on several machines, so do not weigh small differences: {}.",
            scenes.join(", ")
        ),
    }
}

/// Writes points, table, charts and page into the store's folder; names what was written, and remarks.
///
/// # Errors
/// A point that cannot be charted; a file cannot be written.
pub fn write(store: &Store, title: &str, about: &str) -> Result<(Vec<PathBuf>, Vec<Problem>), Problems> {
    let points = points(store)?;
    let lines = points.iter().map(to_line).collect::<Result<String, Problem>>()?;
    let mut wrote = vec![store.write(POINTS, lines.as_bytes())?];
    wrote.push(store.write("points.csv", csv::points(&points).as_bytes())?);
    let picture = |name: &str| {
        let path = store.folder().join(name);
        std::fs::read(&path).map_err(|error| crate::file_problem(&path, &error))
    };
    let metrics: Vec<&Metric> = SVG_METRICS.iter().filter_map(|name| Metric::named(name)).collect();
    let folder = store.folder().join("svg");
    std::fs::create_dir_all(&folder).map_err(|error| crate::file_problem(&folder, &error))?;
    for (name, text) in files::charts(&points, &metrics, &front) {
        store.write(&format!("svg/{name}"), text.as_bytes())?;
    }
    let about = [about, &mixed(&points)].join(" ");
    let options = Options {
        title,
        about: about.trim(),
        picture: &picture,
        pictures_max_bytes: PICTURES_MAX_BYTES,
        front: &front,
    };
    let page = charts(&points, &options)?;
    wrote.push(store.write("chart.html", page.html.as_bytes())?);
    Ok((wrote, page.remarks))
}
