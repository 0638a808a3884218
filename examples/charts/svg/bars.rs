//! Which node has the time: a bar for each variant, a piece for each node, coloured by stage.

use super::Chart;
use super::axis::Axis;
use super::canvas::{Anchor, Canvas, LETTER, WIDTH, px};
use crate::model::{NodeCost, Point};
use crate::number::{count, figure};
use crate::style::{STAGE_COLOURS, Styles};

/// What to draw.
#[derive(Clone, Copy, Debug)]
pub struct Bars<'a> {
    /// Headline.
    pub title: &'a str,
    /// Points of one scene and view, in the order of the bars.
    pub points: &'a [&'a Point],
    /// Looks.
    pub styles: &'a Styles,
}

const ROW: f64 = 20.0;
const BAR: f64 = 14.0;
const RIGHT: f64 = WIDTH - 92.0;
/// The axis ends at this many times the middle bar: one slow truth must not flatten all others.
const LONGEST: f64 = 5.0;

/// The chart; every point is in it or among those not shown.
pub fn bars(spec: &Bars) -> Chart {
    let mut chart = Chart::default();
    let mut rows: Vec<(&Point, f64)> = Vec::new();
    for point in spec.points {
        let total: f64 = point.nodes.iter().map(|node| node.millis).sum();
        let why = match &point.failure {
            Some(failure) => Some(failure.clone()),
            None if point.nodes.is_empty() => Some("it has no times of nodes".into()),
            None if !total.is_finite() || point.nodes.iter().any(|node| node.millis < 0.0) => {
                Some("a node's time is not a time".into())
            }
            None => None,
        };
        match why {
            Some(why) => chart.not_shown.push((point.id.clone(), why)),
            None => {
                chart.shown.push(point.id.clone());
                rows.push((point, total));
            }
        }
    }
    let frame = |point: &Point| point.millis.map(|time| time.median).filter(|median| median.is_finite());
    let letters = rows.iter().map(|(point, _)| point.label.chars().count()).max().unwrap_or(0);
    let left = (letters as f64 * LETTER + 36.0).clamp(100.0, 250.0);
    let mut ends: Vec<f64> = rows.iter().map(|(point, total)| total.max(frame(point).unwrap_or(0.0))).collect();
    ends.sort_by(f64::total_cmp);
    let cut = ends.get(ends.len() / 2).map_or(1.0, |middle| middle * LONGEST);
    let end = ends.last().copied().unwrap_or(1.0).min(cut);
    let axis = Axis::linear([0.0, end], true, [left, RIGHT]);
    let keys = stage_keys(&rows, spec.styles);
    let top = 40.0 + keys.len() as f64 * 18.0;
    let foot = top + rows.len() as f64 * ROW + 6.0;
    let mut canvas = Canvas::new(WIDTH, foot + 42.0, &format!("{}: milliseconds by node", spec.title));
    canvas.bold(14.0, 22.0, Anchor::Start, spec.title);
    for (row, keys) in keys.iter().enumerate() {
        let mut x = 14.0;
        for (stage, name) in keys {
            piece(&mut canvas, [x, 32.0 + row as f64 * 18.0, 12.0, 12.0], *stage, "");
            canvas.text(x + 17.0, 42.0 + row as f64 * 18.0, Anchor::Start, name);
            x += key_width(name);
        }
    }
    if rows.is_empty() {
        canvas.muted(WIDTH / 2.0, foot + 16.0, Anchor::Middle, "no variant has times of nodes");
        chart.svg = canvas.finish();
        return chart;
    }
    canvas.axis_below(&axis, [top, foot], 7);
    let mut caption = String::from("milliseconds with node timers on; line: the frame with timers off");
    if ends.last().is_some_and(|longest| *longest > end) {
        caption += "; arrow: not to scale";
    }
    canvas.muted((left + RIGHT) / 2.0, foot + 34.0, Anchor::Middle, &caption);
    for (row, (point, total)) in rows.iter().enumerate() {
        let y = top + row as f64 * ROW + 4.0;
        canvas.markup.open("g", &[("data-m", &point.graph)]).line();
        canvas.mark([left - 12.0, y + BAR / 2.0], spec.styles, &point.graph, spec.styles.is_hollow(&point.backend), "");
        let label = shortened(&point.label, ((left - 26.0) / LETTER) as usize);
        canvas.text(left - 24.0, y + BAR - 3.0, Anchor::End, &label);
        // A bar that leaves the paper shows its pieces in proportion.
        let scale = if *total > end { end / total } else { 1.0 };
        let mut done = 0.0;
        for node in &point.nodes {
            let [from, to] = [done, done + node.millis].map(|millis| axis.at(millis * scale));
            done += node.millis;
            if to > from {
                piece(
                    &mut canvas,
                    [from, y, to - from, BAR],
                    spec.styles.stage(&node.stage),
                    &tooltip(point, node, *total),
                );
            }
        }
        if *total > end {
            let arrow = format!("M{} {}l8 5l-8 5z", px(RIGHT + 2.0), px(y + BAR / 2.0 - 5.0));
            canvas.markup.leaf("path", &[("class", "ink f"), ("d", &arrow)]).line();
        }
        if let Some(frame) = frame(point).filter(|frame| *frame <= end) {
            let x = axis.at(frame);
            canvas.ink_line([x, y - 2.0], [x, y + BAR + 2.0], "2");
        }
        canvas.text(RIGHT + 14.0, y + BAR - 3.0, Anchor::Start, &format!("{} ms", figure(*total)));
        canvas.markup.close().line();
    }
    canvas.axis_line([left, top], [left, foot]);
    chart.svg = canvas.finish();
    chart
}

fn piece(canvas: &mut Canvas, [x, y, width, height]: [f64; 4], stage: usize, tooltip: &str) {
    let class = format!("g{stage} piece");
    let [x, y, width, height] = [x, y, width, height].map(px);
    canvas.markup.open(
        "rect",
        &[
            ("class", &class),
            ("x", &x),
            ("y", &y),
            ("width", &width),
            ("height", &height),
            ("fill", STAGE_COLOURS[stage][0]),
            ("stroke", super::canvas::PAPER),
            ("stroke-width", "0.7"),
        ],
    );
    if !tooltip.is_empty() {
        canvas.markup.element("title", &[], tooltip);
    }
    canvas.markup.close().line();
}

fn tooltip(point: &Point, node: &NodeCost, total: f64) -> String {
    let mut text = format!("{}: {} = {}/{}\n{} ms", point.label, node.node, node.stage, node.pass, figure(node.millis));
    if total > 0.0 {
        text += &format!(", {} % of its nodes", figure((100.0 * node.millis / total * 10.0).round() / 10.0));
    }
    if node.bytes > 0 {
        text += &format!("\n{} bytes", count(node.bytes));
    }
    for (name, value) in &node.counts {
        text += &format!("\n{name}: {}", count(*value));
    }
    text
}

/// Rows of (colour, name) of the stages drawn; those that share the last colour are named together.
fn stage_keys(rows: &[(&Point, f64)], styles: &Styles) -> Vec<Vec<(usize, String)>> {
    let is_drawn = |stage: &&String| rows.iter().any(|(point, _)| point.nodes.iter().any(|node| node.stage == **stage));
    let mut keys: Vec<(usize, String)> = Vec::new();
    for stage in styles.stages().iter().filter(is_drawn) {
        let colour = styles.stage(stage);
        match keys.iter_mut().find(|(key, _)| *key == colour) {
            Some((_, names)) => *names += &format!(", {stage}"),
            None => keys.push((colour, stage.clone())),
        }
    }
    let mut lines: Vec<Vec<(usize, String)>> = Vec::new();
    let mut used = f64::MAX;
    for (colour, name) in keys {
        let name = shortened(&name, 100);
        if used + key_width(&name) > WIDTH - 20.0 {
            lines.push(Vec::new());
            used = 14.0;
        }
        used += key_width(&name);
        lines.last_mut().into_iter().for_each(|line| line.push((colour, name.clone())));
    }
    lines
}

fn key_width(name: &str) -> f64 {
    name.chars().count() as f64 * LETTER + 34.0
}

/// At most `most` letters, the last an ellipsis where some are missing.
pub(super) fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let kept: String = text.chars().take(most.saturating_sub(1)).collect();
    kept + "…"
}
