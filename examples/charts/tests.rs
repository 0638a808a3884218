//! What holds for every chart and page, on the synthetic set.

use crate::check::Record;
use crate::front::front;
use crate::metric::{FRAME_FIGURES, METRICS, Metric};
use crate::model::{Interval, Point, Stability};
use crate::style::Styles;
use crate::svg::bars::{Bars, bars};
use crate::svg::scatter::{Scatter, scatter};
use crate::svg::sequence::{Lines, lines};
use crate::svg::{Chart, heat};
use crate::synthetic;
use std::collections::BTreeSet;

fn styles(points: &[Point]) -> Styles {
    let stages = points.iter().flat_map(|point| point.nodes.iter().map(|node| (node.stage.as_str(), node.millis)));
    let styles = Styles::new(points.iter().map(|point| point.graph.as_str()), stages);
    styles.backends(points.iter().map(|point| point.backend.as_str()))
}

fn scatter_of(points: &[&Point], metric: &Metric) -> Chart {
    let owned: Vec<Point> = points.iter().map(|point| (*point).clone()).collect();
    let styles = styles(&owned);
    let front = front(points, metric);
    let spec = Scatter { title: "t", points, metric, front: &front, styles: &styles, with_legend: true };
    scatter(&spec)
}

/// Every id once, shown or not, and the drawing is XML with finite coordinates.
fn assert_sound<'a>(chart: &Chart, ids: impl IntoIterator<Item = &'a str>) {
    let not_shown = chart.not_shown.iter().map(|(id, _)| id.as_str());
    let mut told: Vec<&str> = chart.shown.iter().map(String::as_str).chain(not_shown).collect();
    told.sort_unstable();
    let mut ids: Vec<&str> = ids.into_iter().collect();
    ids.sort_unstable();
    assert_eq!(told, ids);
    assert!(chart.not_shown.iter().all(|(_, why)| !why.is_empty()));
    assert_drawing(&chart.svg);
}

fn assert_drawing(svg: &str) {
    let document = roxmltree::Document::parse(svg).unwrap_or_else(|error| panic!("{error}: {svg}"));
    assert_eq!(document.root_element().tag_name().namespace(), Some("http://www.w3.org/2000/svg"));
    for node in document.descendants().filter(roxmltree::Node::is_element) {
        for attribute in node.attributes().filter(|attribute| attribute.name() != "aria-label") {
            let value = attribute.value();
            assert!(!value.contains("NaN") && !value.contains("inf"), "{} {value}", attribute.name());
        }
    }
}

fn marks(svg: &str) -> usize {
    let document = roxmltree::Document::parse(svg).unwrap();
    document.descendants().filter(|node| node.has_tag_name("title")).count()
}

#[test]
fn the_synthetic_set_is_large_and_sound() {
    let points = synthetic::points();
    let methods: BTreeSet<_> = points.iter().map(|point| &point.graph).collect();
    assert_eq!((methods.len(), synthetic::SCENES.len()), (12, 6));
    points.iter().for_each(|point| point.check().unwrap());
    synthetic::stabilities().iter().for_each(|record| record.check().unwrap());
    let ids: BTreeSet<_> = points.iter().map(|point| &point.id).collect();
    assert_eq!(ids.len(), points.len());
}

#[test]
fn every_point_is_drawn_once_or_said_not_to_be() {
    let all = synthetic::points();
    for scene in synthetic::SCENES {
        let points: Vec<&Point> = all.iter().filter(|point| point.scene == scene).collect();
        for metric in METRICS {
            let chart = scatter_of(&points, metric);
            assert_sound(&chart, points.iter().map(|point| point.id.as_str()));
            assert_eq!(marks(&chart.svg), chart.shown.len(), "a tooltip a mark");
        }
        let styles = styles(&all);
        let chart = bars(&Bars { title: scene, points: &points, styles: &styles });
        assert_sound(&chart, points.iter().map(|point| point.id.as_str()));
    }
    let hairball: Vec<&Point> = all.iter().filter(|point| point.scene == "hairball").collect();
    let chart = scatter_of(&hairball, Metric::named("wrong_bit_share").unwrap());
    let reasons: BTreeSet<_> = chart.not_shown.iter().map(|(_, why)| why.split(';').next().unwrap()).collect();
    let expected =
        ["lu_table.lu: the table does not fit the device", "the method answers with a fraction, not with a mask"];
    assert_eq!(reasons.into_iter().collect::<Vec<_>>(), expected);
}

#[test]
fn every_record_is_a_line_or_said_not_to_be() {
    let all = synthetic::stabilities();
    let styles = Styles::new(all.iter().map(|record| record.graph.as_str()), []);
    let scenes: BTreeSet<&str> = all.iter().map(|record| record.scene.as_str()).collect();
    for scene in scenes {
        let records: Vec<&Stability> = all.iter().filter(|record| record.scene == scene).collect();
        for figure in FRAME_FIGURES {
            let spec = Lines { title: scene, records: &records, figure, styles: &styles, with_legend: true };
            assert_sound(&lines(&spec), records.iter().map(|record| record.id.as_str()));
        }
    }
}

#[test]
fn nothing_at_all_is_still_a_chart() {
    assert_sound(&scatter_of(&[], &METRICS[0]), []);
    assert_sound(&bars(&Bars { title: "", points: &[], styles: &Styles::default() }), []);
    let figure = &FRAME_FIGURES[0];
    let spec = Lines { title: "", records: &[], figure, styles: &Styles::default(), with_legend: true };
    assert_sound(&lines(&spec), []);
    assert_drawing(&heat::heat("", &[], &[], |_, _| heat::Cell::default()));
}

#[test]
fn figures_that_are_no_numbers_are_listed_and_never_drawn() {
    let good = synthetic::points().swap_remove(0);
    let with = |id: &str, change: &dyn Fn(&mut Point)| {
        let mut point = good.clone();
        point.id = id.into();
        change(&mut point);
        point
    };
    let interval = |low, median, high| Some(Interval { low, median, high });
    let bad = [
        with("nan_error", &|point| point.errors.rmse_penumbra = Some(f64::NAN)),
        with("infinite_error", &|point| point.errors.rmse_penumbra = Some(f64::INFINITY)),
        with("negative_error", &|point| point.errors.rmse_penumbra = Some(-1.0)),
        with("nan_time", &|point| point.millis = interval(f64::NAN, f64::NAN, f64::NAN)),
        with("nan_end", &|point| point.millis = interval(1.0, 2.0, f64::NAN)),
        with("no_time", &|point| point.millis = None),
        with("time_of_zero", &|point| point.millis = interval(0.0, 0.0, 0.0)),
        with("turned_interval", &|point| point.millis = interval(3.0, 2.0, 1.0)),
    ];
    let points: Vec<&Point> = bad.iter().chain([&good]).collect();
    let chart = scatter_of(&points, Metric::named("rmse_penumbra").unwrap());
    assert_sound(&chart, points.iter().map(|point| point.id.as_str()));
    assert_eq!(chart.shown, [good.id.clone()]);
    let node = with("nan_node", &|point| point.nodes[0].millis = f64::NAN);
    let chart = bars(&Bars { title: "", points: &[&node], styles: &Styles::default() });
    assert_sound(&chart, ["nan_node"]);
    assert!(chart.shown.is_empty());
}

#[test]
fn right_answers_lie_on_the_rail_below_all_others() {
    let points = synthetic::points();
    let points: Vec<&Point> = points.iter().filter(|point| point.scene == "sponza").collect();
    let metric = Metric::named("rmse_penumbra").unwrap();
    let svg = scatter_of(&points, metric).svg;
    let document = roxmltree::Document::parse(&svg).unwrap();
    let height = |label: &str| {
        let is_mark =
            |node: &roxmltree::Node| node.text().is_some_and(|text| text.starts_with(&format!("{label} (cpu)")));
        let title = document.descendants().find(is_mark).unwrap();
        let path = title.ancestors().find_map(|node| node.attribute("d")).unwrap();
        path.split([' ', 'm']).nth(1).unwrap().parse::<f64>().unwrap()
    };
    let lines = document.descendants().filter(|node| node.has_attribute("stroke-dasharray"));
    let rail: f64 = lines.map(|line| line.attribute("y1").unwrap().parse().unwrap()).next().unwrap();
    for point in points.iter().filter(|point| point.backend == "cpu") {
        let below = height(&point.label) > rail;
        assert_eq!(below, metric.of(&point.errors) == Some(0.0), "{}", point.label);
    }
}
