//! A figure along a sequence: where methods part.

use super::Chart;
use super::axis::Axis;
use super::canvas::{Anchor, Canvas, WIDTH};
use super::legend;
use crate::metric::FrameFigure;
use crate::model::{Stability, Verdict};
use crate::number::figure;
use crate::style::Styles;

/// What to draw.
#[derive(Clone, Copy, Debug)]
pub struct Lines<'a> {
    /// Headline: scene and sequence.
    pub title: &'a str,
    /// Records of one scene and sequence.
    pub records: &'a [&'a Stability],
    /// Vertical axis.
    pub figure: &'a FrameFigure,
    /// Looks.
    pub styles: &'a Styles,
    /// Whether the picture carries its own legend.
    pub with_legend: bool,
}

const LEFT: f64 = 62.0;
const RIGHT: f64 = WIDTH - 18.0;
const TOP: f64 = 60.0;
const BOTTOM: f64 = TOP + 240.0;
/// Distance of methods beside each other on the rail of zero.
const LANE: f64 = 9.0;
/// Marks on a line at most, besides its worst frame.
const MARKS: usize = 16;
/// An axis is logarithmic when its largest figure is more than this above the middle one: even steps are not.
const WIDE: f64 = 10.0;

/// The chart; every record is in it or among those not shown.
pub fn lines(spec: &Lines) -> Chart {
    let mut chart = Chart::default();
    let mut drawn = Vec::new();
    for record in spec.records {
        let frames = record.frames.iter().filter_map(|frame| Some([frame.value, spec.figure.of(frame)?]));
        let frames: Vec<[f64; 2]> =
            frames.filter(|[value, y]| value.is_finite() && y.is_finite() && *y >= 0.0).collect();
        match &record.verdict {
            Verdict::NotRun { why } if frames.is_empty() => chart.not_shown.push((record.id.clone(), why.clone())),
            _ if frames.is_empty() => {
                chart.not_shown.push((record.id.clone(), format!("no frame has {}", spec.figure.title)));
            }
            _ => {
                chart.shown.push(record.id.clone());
                drawn.push((*record, frames));
            }
        }
    }
    let values = || drawn.iter().flat_map(|(_, frames)| frames.iter().map(|[value, _]| *value));
    let figures = || drawn.iter().flat_map(|(_, frames)| frames.iter().map(|[_, y]| *y));
    let lanes: Vec<&str> = drawn
        .iter()
        .filter(|(_, frames)| frames.iter().any(|[_, y]| *y <= 0.0))
        .map(|(record, _)| record.id.as_str())
        .collect();
    let rail = if lanes.is_empty() { 0.0 } else { 10.0 + lanes.len() as f64 * LANE };
    let foot = BOTTOM + rail;
    let thresholds = || drawn.iter().filter(|(r, _)| r.judged_by == spec.figure.name).filter_map(|(r, _)| r.threshold);
    let above_zero = thresholds().filter(|threshold| *threshold > 0.0);
    let up = Axis::log(figures().chain(above_zero), [BOTTOM - 6.0, TOP + 6.0], BOTTOM + rail / 2.0);
    let across = across(values().collect());
    let mut methods: Vec<&str> = drawn.iter().map(|(record, _)| record.graph.as_str()).collect();
    methods.sort_by_key(|method| spec.styles.method(method));
    methods.dedup();
    let legend_height = if spec.with_legend { legend::height(&methods, WIDTH - LEFT) + 12.0 } else { 0.0 };
    let label = format!("{}: {} along the sequence", spec.title, spec.figure.title);
    let mut canvas = Canvas::new(WIDTH, foot + 44.0 + legend_height, &label);
    canvas.bold(14.0, 22.0, Anchor::Start, spec.title);
    canvas.text(14.0, 44.0, Anchor::Start, spec.figure.title);
    if drawn.is_empty() {
        canvas.muted(WIDTH / 2.0, (TOP + BOTTOM) / 2.0, Anchor::Middle, "no method has this figure here");
        chart.svg = canvas.finish();
        return chart;
    }
    canvas.axis_below(&across, [TOP, foot], 8);
    if figures().any(|y| y > 0.0) {
        canvas.axis_beside(&up, [LEFT, RIGHT], 7);
    }
    if !lanes.is_empty() {
        canvas.dashed_line([LEFT, BOTTOM], [RIGHT, BOTTOM]);
        canvas.bold(LEFT - 7.0, BOTTOM + rail / 2.0 + 4.0, Anchor::End, "0");
    }
    let mut seen: Vec<f64> = Vec::new();
    for threshold in thresholds().filter(|threshold| *threshold > 0.0) {
        if !seen.contains(&threshold) {
            seen.push(threshold);
            let y = up.at(threshold);
            canvas.ink_line([LEFT, y], [RIGHT, y], "0.8");
            canvas.muted(RIGHT - 4.0, y - 4.0, Anchor::End, &format!("threshold {}", figure(threshold)));
        }
    }
    canvas.axis_line([LEFT, TOP], [LEFT, foot]);
    canvas.axis_line([LEFT, foot], [RIGHT, foot]);
    let first = spec.records.first();
    let unit = first.map(|record| record.unit.as_str()).filter(|unit| !unit.is_empty());
    let parameter = first.map_or("", |record| record.parameter.as_str());
    let caption = unit.map_or(parameter.into(), |unit| format!("{parameter}, {unit}"));
    canvas.muted((LEFT + RIGHT) / 2.0, foot + 34.0, Anchor::Middle, &caption);
    for (record, frames) in &drawn {
        let lane = lanes.iter().position(|id| *id == record.id).unwrap_or(0) as f64;
        let offset = (lane - (lanes.len() as f64 - 1.0) / 2.0) * LANE;
        draw(&mut canvas, spec, record, frames, [&across, &up], offset);
    }
    if spec.with_legend {
        legend::draw(&mut canvas, &methods, spec.styles, [LEFT, foot + 58.0]);
    }
    chart.svg = canvas.finish();
    chart
}

/// Logarithmic where the parameter spans decades above zero; a zero among them gets a place left of the rest.
fn across(values: Vec<f64>) -> Axis {
    let mut positive: Vec<f64> = values.iter().copied().filter(|value| *value > 0.0).collect();
    positive.sort_by(f64::total_cmp);
    let middle = positive.get(positive.len() / 2).copied().unwrap_or(0.0);
    let high = positive.last().copied().unwrap_or(0.0);
    let is_log = values.iter().all(|value| *value >= 0.0) && high > WIDE * middle;
    if is_log && positive.len() < values.len() {
        Axis::log(values, [LEFT + 44.0, RIGHT - 8.0], LEFT + 14.0).with_zero_tick()
    } else if is_log {
        Axis::log(values, [LEFT + 8.0, RIGHT - 8.0], LEFT)
    } else {
        Axis::linear(values, false, [LEFT + 8.0, RIGHT - 8.0])
    }
}

/// `offset` is from the middle of the rail to this record's lane.
fn draw(
    canvas: &mut Canvas,
    spec: &Lines,
    record: &Stability,
    frames: &[[f64; 2]],
    [across, up]: [&Axis; 2],
    offset: f64,
) {
    let height = |y: f64| up.at(y) + if y <= 0.0 { offset } else { 0.0 };
    let places: Vec<[f64; 2]> = frames.iter().map(|[value, y]| [across.at(*value), height(*y)]).collect();
    canvas.markup.open("g", &[("data-m", &record.graph)]).line();
    canvas.method_path(&places, spec.styles, &record.graph, "1.6");
    let worst = (0..frames.len()).max_by(|a, b| frames[*a][1].total_cmp(&frames[*b][1]));
    let stride = frames.len().div_ceil(MARKS).max(1);
    // Marks of methods that lie on each other start at different frames, so that each can be seen.
    let phase = spec.styles.method(&record.graph) % stride;
    for (index, [value, y]) in frames.iter().enumerate() {
        if index % stride != phase && Some(index) != worst {
            continue;
        }
        let unit = if record.unit.is_empty() { String::new() } else { format!(" {}", record.unit) };
        let tooltip = format!(
            "{} ({})\n{}: {}{unit}\n{}: {}",
            record.label,
            record.backend,
            record.parameter,
            figure(*value),
            spec.figure.title,
            figure(*y)
        );
        canvas.mark(places[index], spec.styles, &record.graph, spec.styles.is_hollow(&record.backend), &tooltip);
    }
    canvas.markup.close().line();
}
