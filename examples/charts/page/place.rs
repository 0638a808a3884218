//! One scene and view: charts, costs, pictures, figures.

use super::album::Album;
use super::{FindFront, pictures, table};
use crate::front::Front;
use crate::group::Place;
use crate::markup::Markup;
use crate::metric::{METRICS, Metric};
use crate::model::Point;
use crate::number::figure;
use crate::style::Styles;
use crate::svg::bars::{Bars, bars};
use crate::svg::legend;
use crate::svg::scatter::{Scatter, scatter};
use std::collections::BTreeMap;

/// What a section is made from.
pub struct Section<'a> {
    pub place: &'a Place,
    /// In the order of legends, then by time.
    pub points: Vec<&'a Point>,
    /// The error that leads: open without a script, and what tables rank by.
    pub metric: &'static Metric,
    pub front: Front,
}

impl<'a> Section<'a> {
    pub fn new(place: &'a Place, points: &[&'a Point], styles: &Styles, find: &FindFront) -> Self {
        let mut points = points.to_vec();
        let time = |point: &Point| point.millis.map_or(f64::MAX, |time| time.median);
        points.sort_by(|a, b| {
            let order = |point: &Point| (styles.method(&point.graph), styles.is_hollow(&point.backend));
            order(a).cmp(&order(b)).then(time(a).total_cmp(&time(b)))
        });
        let has = |metric: &&Metric| points.iter().any(|point| metric.of(&point.errors).is_some());
        let metric = METRICS.iter().find(has).unwrap_or(&METRICS[0]);
        let front = find(&points, metric);
        Self { place, points, metric, front }
    }

    fn label(&self, id: &str) -> String {
        self.points.iter().find(|point| point.id == id).map_or_else(|| id.into(), |point| name(point, &self.points))
    }

    /// Points by how much their pictures tell: the front, then one of each method and backend, then the rest.
    pub fn ranked(&self) -> Vec<(u8, &'a Point)> {
        let mut seen = Vec::new();
        let mut ranked: Vec<(u8, &Point)> = Vec::new();
        for point in self.points.iter().filter(|point| pictures::has_any(point)) {
            let kind = (&point.graph, &point.backend);
            let rank = if self.front.has(&point.id) { 0 } else { 1 + u8::from(seen.contains(&kind)) };
            seen.push(kind);
            ranked.push((rank, point));
        }
        ranked
    }

    pub fn write(&self, markup: &mut Markup, index: usize, styles: &Styles, album: &Album, find: &FindFront) {
        let id = format!("place-{index}");
        markup.open("section", &[("class", "place"), ("id", &id)]).line();
        let [width, height] = self.place.size;
        let samples: std::collections::BTreeSet<usize> = self.points.iter().map(|point| point.light_samples).collect();
        let samples: Vec<String> = samples.into_iter().map(|count| count.to_string()).collect();
        markup.open("h2", &[]).text(&self.place.title()).text(" ");
        let facts = format!("{width}×{height} px, {} light samples", samples.join(" or "));
        markup.element("small", &[], &facts).close().line();
        markup.element("h3", &[], "Time against error").line();
        self.against(markup, self.metric, styles, find);
        markup.open("details", &[("class", "others")]).element("summary", &[], "Against other errors").line();
        for metric in METRICS.iter().filter(|metric| metric.name != self.metric.name) {
            self.against(markup, metric, styles, find);
        }
        markup.close().line();
        self.costs(markup, styles);
        self.pictures(markup, album);
        self.figures(markup, styles);
        markup.close().line();
    }

    fn against(&self, markup: &mut Markup, metric: &Metric, styles: &Styles, find: &FindFront) {
        let front = find(&self.points, metric);
        let title = self.place.title();
        let spec = Scatter { title: &title, points: &self.points, metric, front: &front, styles, with_legend: false };
        let chart = scatter(&spec);
        markup.open("div", &[("class", "against"), ("data-metric", metric.name)]).line();
        markup.open("figure", &[("class", "chart-box scroll"), ("tabindex", "0")]).raw(&chart.svg);
        markup.element("figcaption", &[], &format!("{}: {}.", metric.title, metric.doc)).close().line();
        markup.open("div", &[("class", "ranks")]).element("h4", &[], "On the front").open("ol", &[]);
        let find = |id: &String| self.points.iter().find(|point| point.id == *id);
        for point in front.on.iter().filter_map(find) {
            let time = point.millis.map_or(0.0, |time| time.median);
            let error = figure(metric.of(&point.errors).unwrap_or(0.0));
            let text = format!("{}: {} ms, {error}", name(point, &self.points), figure(time));
            markup.open("li", &[("data-m", &point.graph)]).raw(&legend::mark(styles, &point.graph)).text(&text).close();
        }
        markup.close().line();
        self.dominated(markup, &front);
        not_shown(markup, "Not in this chart", &chart.not_shown, |id| self.label(id));
        markup.close().close().line();
    }

    fn dominated(&self, markup: &mut Markup, front: &Front) {
        if front.dominated.is_empty() {
            return;
        }
        let mut by: Vec<(&str, Vec<String>)> = Vec::new();
        let time = |id: &str| self.points.iter().find(|point| point.id == id).and_then(|point| point.millis);
        for (id, winner) in &front.dominated {
            let overlap = time(id).zip(time(winner)).is_some_and(|(time, winner)| winner.high >= time.low);
            let label = format!("{}{}", self.label(id), if overlap { "*" } else { "" });
            match by.iter_mut().find(|(have, _)| have == winner) {
                Some((_, labels)) => labels.push(label),
                None => by.push((winner, vec![label])),
            }
        }
        markup.open("details", &[("open", "open")]);
        markup.element("summary", &[], &format!("Dominated: {}", front.dominated.len())).open("dl", &[]);
        let starred = by.iter().any(|(_, labels)| labels.iter().any(|label| label.ends_with('*')));
        for (winner, labels) in by {
            markup.element("dt", &[], &format!("by {}", self.label(winner)));
            markup.element("dd", &[], &labels.join(", "));
        }
        markup.close();
        if starred {
            markup.element(
                "p",
                &[("class", "note")],
                "* intervals of time overlap: as right at least, but not surely faster",
            );
        }
        markup.close().line();
    }

    fn costs(&self, markup: &mut Markup, styles: &Styles) {
        let title = self.place.title();
        let chart = bars(&Bars { title: &title, points: &self.points, styles });
        markup.element("h3", &[], "Cost by node").line();
        markup.open("div", &[("class", "against")]).open("figure", &[("class", "chart-box scroll"), ("tabindex", "0")]);
        markup.raw(&chart.svg).close().open("div", &[("class", "ranks")]);
        let mut left_out: BTreeMap<&(String, String), Vec<String>> = BTreeMap::new();
        for point in &self.points {
            for entry in &point.left_out {
                left_out.entry(entry).or_default().push(name(point, &self.points));
            }
        }
        if !left_out.is_empty() {
            markup.element("h4", &[], "Not needed by this scene").open("ul", &[]);
            for ((node, reason), labels) in left_out {
                let whose = match labels.len() {
                    all if all == self.points.len() => "all variants".into(),
                    _ => labels.join(", "),
                };
                markup.element("li", &[], &format!("{node}: {reason} ({whose})"));
            }
            markup.close();
        }
        not_shown(markup, "Without bars", &chart.not_shown, |id| self.label(id));
        markup.close().close().line();
    }

    fn pictures(&self, markup: &mut Markup, album: &Album) {
        let ranked = self.ranked();
        if ranked.is_empty() {
            return;
        }
        let caption = |point: &Point| {
            let error = self.metric.of(&point.errors).map(|error| format!(", {} {}", self.metric.title, figure(error)));
            let time = point.millis.map_or_else(String::new, |time| format!(": {} ms", figure(time.median)));
            format!("{}{time}{}", name(point, &self.points), error.unwrap_or_default())
        };
        let of = |wanted: &dyn Fn(u8) -> bool| -> Vec<&Point> {
            ranked.iter().filter(|(rank, _)| wanted(*rank)).map(|(_, point)| *point).collect()
        };
        markup.element("h3", &[], "Pictures").line();
        pictures::scale(markup);
        pictures::rows(markup, album, &of(&|rank| rank < 2), caption);
        let rest = of(&|rank| rank == 2);
        if !rest.is_empty() {
            markup.open("details", &[]).element("summary", &[], &format!("{} further variants", rest.len())).line();
            pictures::rows(markup, album, &rest, caption);
            markup.close().line();
        }
    }

    fn figures(&self, markup: &mut Markup, styles: &Styles) {
        markup.element("h3", &[], "Figures").line();
        let standing = format!("by {}", self.metric.title);
        let mut columns = vec![
            ("variant", ""),
            ("on", "backend"),
            ("ms", "milliseconds a frame: median and its interval"),
            ("runs", "timed runs"),
            ("front", standing.as_str()),
        ];
        columns.extend(METRICS.iter().map(|metric| (metric.title, metric.doc)));
        table::open(markup, "", &columns);
        for point in &self.points {
            markup.open("tr", &[("data-m", &point.graph)]);
            markup.open("th", &[("scope", "row")]).raw(&legend::mark(styles, &point.graph)).text(&point.label).close();
            table::text(markup, &point.backend);
            if let Some(failure) = &point.failure {
                let span = (columns.len() - 2).to_string();
                markup.element("td", &[("colspan", &span), ("class", "failure")], failure).close().line();
                continue;
            }
            table::millis(markup, point.millis);
            table::number(markup, Some(f64::from(point.runs_count)));
            let standing = match self.front.dominator(&point.id) {
                _ if self.front.has(&point.id) => "front".into(),
                Some(by) => format!("behind {}", self.label(by)),
                None => "–".into(),
            };
            table::text(markup, &standing);
            METRICS.iter().for_each(|metric| table::number(markup, metric.of(&point.errors)));
            markup.close().line();
        }
        table::close(markup);
    }
}

/// The label, with the backend where another point has the same label.
pub fn name(point: &Point, points: &[&Point]) -> String {
    let is_alone = points.iter().filter(|other| other.label == point.label).count() < 2;
    if is_alone { point.label.clone() } else { format!("{} ({})", point.label, point.backend) }
}

/// Records by the reason why they are absent.
pub fn not_shown(markup: &mut Markup, title: &str, records: &[(String, String)], label: impl Fn(&str) -> String) {
    if records.is_empty() {
        return;
    }
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for (id, why) in records {
        match reasons.iter_mut().find(|(have, _)| have == why) {
            Some((_, labels)) => labels.push(label(id)),
            None => reasons.push((why, vec![label(id)])),
        }
    }
    markup.open("details", &[("open", "open")]);
    markup.element("summary", &[], &format!("{title}: {}", records.len())).open("dl", &[]);
    for (why, labels) in reasons {
        markup.element("dt", &[], why).element("dd", &[], &labels.join(", "));
    }
    markup.close().close().line();
}
