//! What holds for every chart and page, on the synthetic set.

use crate::check::Record;
use crate::front::front;
use crate::metric::{FRAME_FIGURES, METRICS, Metric};
use crate::model::{Interval, Point, Stability};
use crate::page::{self, Options};
use crate::style::Styles;
use crate::svg::bars::{Bars, bars};
use crate::svg::scatter::{Scatter, scatter};
use crate::svg::sequence::{Lines, lines};
use crate::svg::{Chart, heat};
use crate::synthetic;
use shadowgraph_core::problem::Problem;
use std::collections::BTreeSet;

fn scatter_of(points: &[&Point], metric: &Metric) -> Chart {
    let owned: Vec<Point> = points.iter().map(|point| (*point).clone()).collect();
    let styles = Styles::of_points(&owned);
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
        let styles = Styles::of_points(&all);
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
    let styles = Styles::of_stabilities(&all);
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
    assert_eq!(chart.shown, std::slice::from_ref(&good.id));
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

fn png(_: &str) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&synthetic::picture("error").1[..12]).unwrap();
    Ok(bytes)
}

fn options<'a>() -> Options<'a> {
    Options { title: synthetic::ODD, about: synthetic::ODD, picture: &png, pictures_max_bytes: 1 << 20, front: &front }
}

/// The page without its style and script, which are no XML: read as XML it shows whether every tag and text is sound.
fn assert_page(html: &str) -> String {
    let mut text = html.replacen("<!DOCTYPE html>\n", "", 1);
    for (start, end) in [("<style>", "</style>"), ("<script>", "</script>")] {
        let from = text.find(start).unwrap() + start.len();
        let to = from + text[from..].find(end).unwrap();
        text.replace_range(from..to, "");
    }
    let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{error}"));
    let mut ids = BTreeSet::new();
    for node in document.descendants().filter(roxmltree::Node::is_element) {
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            match name {
                "href" if value.starts_with("data:image/png;base64,") => {}
                "href" => assert!(value.starts_with('#'), "{value}"),
                "id" => assert!(ids.insert(value.to_string()), "two of {value}"),
                "src" | "srcset" | "action" | "ping" | "poster" => panic!("{name} in a page that fetches nothing"),
                "points" | "d" | "x" | "y" | "x1" | "y1" | "x2" | "y2" | "width" | "height" | "viewBox" => {
                    assert!(!value.contains("NaN") && !value.contains("inf"), "{name} {value}");
                }
                _ => {}
            }
        }
    }
    let links = document.descendants().filter_map(|node| node.attribute("href"));
    let dangling: Vec<&str> = links.filter_map(|link| link.strip_prefix('#')).filter(|id| !ids.contains(*id)).collect();
    assert!(dangling.is_empty(), "{dangling:?}");
    text
}

fn all_text(page: &str) -> String {
    let document = roxmltree::Document::parse(page).unwrap();
    document.descendants().filter(|node| node.is_text()).filter_map(|node| node.text()).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_page_of_a_suite_has_every_point_and_needs_nothing_else() {
    let points = synthetic::points();
    let page = page::charts(&points, &options()).unwrap();
    assert!(page.remarks.is_empty());
    let text = assert_page(&page.html);
    let words = all_text(&text);
    for point in &points {
        assert!(words.lines().any(|line| line == point.id), "{} is told", point.id);
    }
    assert!(words.contains("the table does not fit the device"), "failures are told");
    assert!(words.contains(synthetic::ODD) && !page.html.contains(synthetic::ODD), "odd text is escaped and kept");
    assert_eq!(page.html.matches("</script>").count(), 1);
    let sections = points.iter().map(|point| &point.scene).collect::<BTreeSet<_>>().len();
    assert_eq!(text.matches("class=\"against\" data-metric").count(), sections * METRICS.len());
}

#[test]
fn the_page_of_stability_tells_what_is_not_as_expected() {
    let records = synthetic::stabilities();
    let page = page::stability(&records, &options()).unwrap();
    let text = assert_page(&page.html);
    let surprises = records.iter().filter(|record| record.verdict.surprises(record.expected)).count();
    assert_eq!(surprises, 3, "the synthetic set has some");
    let document = roxmltree::Document::parse(&text).unwrap();
    let list = document.descendants().find(|node| node.attribute("id") == Some("surprises")).unwrap();
    assert_eq!(list.descendants().filter(|node| node.has_tag_name("li")).count(), surprises);
    let matrix = document.descendants().find(|node| node.attribute("class") == Some("matrix")).unwrap();
    assert_eq!(matrix.descendants().filter(|node| node.has_tag_name("b")).count(), records.len(), "each in one cell");
    let marked = matrix.descendants().filter(|node| node.attribute("class").is_some_and(|c| c.ends_with("surprise")));
    assert_eq!(marked.count(), surprises);
}

#[test]
fn a_suite_in_which_nothing_fails_is_doubted() {
    let mut records = synthetic::stabilities();
    records.retain(|record| record.verdict == crate::model::Verdict::Holds);
    let page = page::stability(&records, &options()).unwrap();
    assert!(page.html.contains("has not shown that it can see a failure"));
    let with_failures = page::stability(&synthetic::stabilities(), &options()).unwrap();
    assert!(!with_failures.html.contains("has not shown that it can see a failure"));
}

#[test]
fn pages_of_nothing_are_pages() {
    assert_page(&page::charts(&[], &options()).unwrap().html);
    assert_page(&page::stability(&[], &options()).unwrap().html);
}

#[test]
fn pages_refuse_what_cannot_be_charted_all_at_once() {
    let mut points = synthetic::points();
    points[0].errors.max = Some(f64::NAN);
    points[1].millis = Some(Interval { median: f64::INFINITY, low: 0.0, high: 0.0 });
    points[3].id = points[2].id.clone();
    let problems = page::charts(&points, &options()).unwrap_err();
    let text = problems.to_string();
    let expected = [
        "errors.max: a record that cannot be charted; expected a number from 0 to 1.0001; found NaN",
        "millis.median: a record that cannot be charted; expected a finite number from 0; found inf",
        "two records with one id",
    ];
    assert_eq!(text.lines().count(), 3, "{text}");
    assert!(text.lines().zip(expected).all(|(line, expected)| line.contains(expected)), "{text}");
    assert!(text.lines().next().unwrap().contains(&points[0].id));
}

#[test]
fn pictures_that_cannot_be_read_are_told_and_stop_nothing() {
    let gone = |name: &str| Err(Problem::new(shadowgraph_core::problem::Kind::File, format!("{name} is gone")));
    let page = page::charts(&synthetic::points(), &Options { picture: &gone, ..options() }).unwrap();
    assert!(page.remarks.len() > 100);
    assert!(assert_page(&page.html).contains("picture.png: cannot be read"));
    let page = page::charts(&synthetic::points(), &Options { pictures_max_bytes: 0, ..options() }).unwrap();
    assert!(page.remarks.is_empty() && !page.html.contains("data:image/png"));
    assert!(page.html.contains("beyond the page"));
}
