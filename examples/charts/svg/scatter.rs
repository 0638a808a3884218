//! Milliseconds against error, both logarithmic: what a millisecond buys.

use super::Chart;
use super::axis::Axis;
use super::canvas::{Anchor, Canvas, WIDTH};
use super::labels::Taken;
use super::legend;
use crate::front::Front;
use crate::metric::Metric;
use crate::model::Point;
use crate::number::{figure, figure_or_dash};
use crate::style::Styles;

/// What to draw.
#[derive(Clone, Copy, Debug)]
pub struct Scatter<'a> {
    /// Headline: scene, view, size.
    pub title: &'a str,
    /// Points of one scene and view.
    pub points: &'a [&'a Point],
    /// Vertical axis.
    pub metric: &'a Metric,
    /// Who is on the front by this metric.
    pub front: &'a Front,
    /// Looks.
    pub styles: &'a Styles,
    /// Whether the picture carries its own legend.
    pub with_legend: bool,
}

const LEFT: f64 = 62.0;
const RIGHT: f64 = WIDTH - 18.0;
const TOP: f64 = 62.0;
const PLOT_HEIGHT: f64 = 340.0;
/// Distance of marks that lie beside each other on the rail.
const LANE: f64 = 12.0;
/// Lanes at most; marks beyond them cover each other.
const LANES: usize = 8;

struct Mark<'a> {
    point: &'a Point,
    millis: f64,
    error: f64,
    place: [f64; 2],
}

/// The chart; every point is in it or among those not shown.
pub fn scatter(spec: &Scatter) -> Chart {
    let mut chart = Chart::default();
    let mut marks = Vec::new();
    for point in spec.points {
        match figures(point, spec.metric) {
            Ok((millis, error)) => {
                chart.shown.push(point.id.clone());
                marks.push(Mark { point, millis, error, place: [0.0; 2] });
            }
            Err(why) => chart.not_shown.push((point.id.clone(), why)),
        }
    }
    let ends = |mark: &Mark| mark.point.millis.map_or([mark.millis; 2], |time| [time.low, time.high]);
    let across = Axis::log(marks.iter().flat_map(ends), [LEFT + 8.0, RIGHT - 8.0], LEFT);
    let lanes = place_on_rail(&mut marks, &across);
    let bottom = TOP + PLOT_HEIGHT;
    let rail = if lanes > 0 { 12.0 + lanes as f64 * LANE } else { 0.0 };
    let up = Axis::log(marks.iter().map(|mark| mark.error), [bottom - 6.0, TOP + 6.0], bottom + rail / 2.0);
    for mark in &mut marks {
        mark.place[1] += up.at(mark.error);
    }
    let foot = bottom + rail;
    let mut methods: Vec<&str> = marks.iter().map(|mark| mark.point.graph.as_str()).collect();
    methods.sort_by_key(|method| spec.styles.method(method));
    methods.dedup();
    let legend_height = if spec.with_legend { legend::height(&methods, WIDTH - LEFT) + 12.0 } else { 0.0 };
    let label = format!("{}: milliseconds against {}", spec.title, spec.metric.title);
    let mut canvas = Canvas::new(WIDTH, foot + 44.0 + legend_height, &label);
    canvas.bold(14.0, 22.0, Anchor::Start, spec.title);
    canvas.text(14.0, 44.0, Anchor::Start, spec.metric.title);
    canvas.muted(RIGHT, 44.0, Anchor::End, "left and down is better; labels and the stepped line: front");
    if marks.is_empty() {
        canvas.muted(WIDTH / 2.0, TOP + PLOT_HEIGHT / 2.0, Anchor::Middle, "no variant has both a time and this error");
    } else {
        canvas.axis_below(&across, [TOP, foot], 12);
        if marks.iter().any(|mark| mark.error > 0.0) {
            canvas.axis_beside(&up, [LEFT, RIGHT], 12);
        }
        canvas.muted((LEFT + RIGHT) / 2.0, foot + 34.0, Anchor::Middle, "milliseconds a frame, median and interval");
    }
    if lanes > 0 {
        canvas.dashed_line([LEFT, bottom], [RIGHT, bottom]);
        canvas.bold(LEFT - 7.0, bottom + rail / 2.0 + 4.0, Anchor::End, "0");
    }
    canvas.axis_line([LEFT, TOP], [LEFT, foot]);
    canvas.axis_line([LEFT, foot], [RIGHT, foot]);
    draw(&mut canvas, spec, &marks, &across, [LEFT, TOP, RIGHT, foot]);
    if spec.with_legend {
        legend::draw(&mut canvas, &methods, spec.styles, [LEFT, foot + 58.0]);
    }
    chart.svg = canvas.finish();
    chart
}

/// Time and error, or why there is no place for them.
fn figures(point: &Point, metric: &Metric) -> Result<(f64, f64), String> {
    if let Some(failure) = &point.failure {
        return Err(failure.clone());
    }
    let time = point.millis.ok_or("it has no time")?;
    let error = metric.of(&point.errors).ok_or(metric.absent)?;
    if ![time.low, time.median, time.high, error].iter().all(|value| value.is_finite()) || error < 0.0 {
        return Err(format!("a figure that is no distance: {} ms, {error}", time.median));
    }
    if time.low <= 0.0 || time.high < time.median || time.median < time.low {
        return Err(format!("an interval with no place on a logarithmic axis: {} .. {} ms", time.low, time.high));
    }
    Ok((time.median, error))
}

/// Gives every mark its x, and those with no error a lane of the rail, as an offset from its middle. Number of lanes.
fn place_on_rail(marks: &mut [Mark], across: &Axis) -> usize {
    for mark in &mut *marks {
        mark.place[0] = across.at(mark.millis);
    }
    let mut right: Vec<&mut Mark> = marks.iter_mut().filter(|mark| mark.error <= 0.0).collect();
    right.sort_by(|a, b| a.place[0].total_cmp(&b.place[0]));
    let mut ends: Vec<f64> = Vec::new();
    let mut lanes = Vec::new();
    for mark in &right {
        let free = ends.iter().position(|end| mark.place[0] - end >= LANE);
        let lane = free.unwrap_or(if ends.len() < LANES { ends.len() } else { lanes.len() % LANES });
        if lane == ends.len() {
            ends.push(f64::MIN);
        }
        ends[lane] = mark.place[0];
        lanes.push(lane);
    }
    let middle = (ends.len() as f64 - 1.0) / 2.0;
    for (mark, lane) in right.iter_mut().zip(lanes) {
        mark.place[1] = (lane as f64 - middle) * LANE;
    }
    ends.len()
}

fn draw(canvas: &mut Canvas, spec: &Scatter, marks: &[Mark], across: &Axis, bounds: [f64; 4]) {
    let mut on: Vec<&Mark> = marks.iter().filter(|mark| spec.front.has(&mark.point.id)).collect();
    on.sort_by(|a, b| a.millis.total_cmp(&b.millis).then(b.error.total_cmp(&a.error)));
    let steps = on.windows(2).flat_map(|pair| {
        let [[_, y], [next, _]] = [pair[0].place, pair[1].place];
        [pair[0].place, [next, y]]
    });
    let end = on.last().into_iter().flat_map(|last| [last.place, [bounds[2], last.place[1]]]);
    let start = on.first().map(|first| [first.place[0], bounds[1]]);
    let steps: Vec<[f64; 2]> = start.into_iter().chain(steps).chain(end).collect();
    if on.len() > 1 || steps.len() > 2 {
        canvas.markup.open("g", &[("opacity", "0.55")]);
        canvas.ink_path(&steps, "1.4");
        canvas.markup.close().line();
    }
    let mut taken = Taken::default();
    marks.iter().for_each(|mark| taken.mark(mark.place));
    taken.line(&steps);
    for series in series(marks) {
        let method = series[0].point.graph.as_str();
        canvas.markup.open("g", &[("data-m", method)]).line();
        let path: Vec<[f64; 2]> = series.iter().map(|mark| mark.place).collect();
        if path.len() > 1 && series[0].point.quality_axis.is_some() {
            canvas.method_path(&path, spec.styles, method, "1.6");
            taken.line(&path);
        }
        for mark in series {
            let ends = mark.point.millis.map_or([mark.millis; 2], |time| [time.low, time.high]);
            canvas.whisker(ends.map(|end| across.at(end)), mark.place[1], spec.styles, method);
            let hollow = spec.styles.is_hollow(&mark.point.backend);
            canvas.mark(mark.place, spec.styles, method, hollow, &tooltip(mark, spec));
        }
        canvas.markup.close().line();
    }
    for mark in on {
        let (place, anchor, is_far) = taken.place(mark.place, &mark.point.label, bounds);
        canvas.markup.open("g", &[("data-m", &mark.point.graph)]);
        if is_far {
            canvas.axis_line(mark.place, [place[0], place[1] - 4.0]);
        }
        let halo =
            [("class", "halo"), ("stroke", super::canvas::PAPER), ("stroke-width", "3"), ("paint-order", "stroke")];
        canvas.styled_text(place[0], place[1], anchor, &mark.point.label, &halo);
        canvas.markup.close().line();
    }
}

/// Marks that one line joins: same method, backend and choices but for the quality axis, in order of quality.
fn series<'a>(marks: &'a [Mark<'a>]) -> Vec<Vec<&'a Mark<'a>>> {
    let mut series: Vec<Vec<&Mark>> = Vec::new();
    for mark in marks {
        let same = |other: &&mut Vec<&Mark>| key(other[0].point) == key(mark.point);
        match series.iter_mut().find(same) {
            Some(found) => found.push(mark),
            None => series.push(vec![mark]),
        }
    }
    for marks in &mut series {
        marks.sort_by(|a, b| quality(a.point).total_cmp(&quality(b.point)));
    }
    series
}

fn key(point: &Point) -> (&str, &str, Option<&str>, Vec<&(String, String)>) {
    let axis = point.quality_axis.as_deref();
    let others = point.choices.iter().filter(|(name, _)| Some(name.as_str()) != axis);
    (&point.graph, &point.backend, axis, others.collect())
}

/// Value of the quality axis; zero where it is not a number, which keeps the suite's order.
fn quality(point: &Point) -> f64 {
    let axis = point.quality_axis.as_deref();
    let value = point.choices.iter().find(|(name, _)| Some(name.as_str()) == axis).map(|(_, value)| value);
    value.and_then(|value| value.parse().ok()).filter(|value: &f64| value.is_finite()).unwrap_or(0.0)
}

fn tooltip(mark: &Mark, spec: &Scatter) -> String {
    let point = mark.point;
    let time = point.millis.map_or(String::new(), |time| format!(" [{}, {}]", figure(time.low), figure(time.high)));
    let by = spec.front.dominator(&point.id);
    let by = by.map(|by| spec.points.iter().find(|point| point.id == by).map_or(by, |point| point.label.as_str()));
    let standing = match by {
        _ if spec.front.has(&point.id) => "on the front".into(),
        Some(by) => format!("dominated by {by}"),
        None => "not ranked".into(),
    };
    format!(
        "{} ({})\n{} ms{time}\n{}: {}\n{standing}",
        point.label,
        point.backend,
        figure(mark.millis),
        spec.metric.title,
        figure_or_dash(Some(mark.error)),
    )
}
