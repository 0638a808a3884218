//! The page of a suite: milliseconds against error for every variant on every scene.

use super::album::Album;
use super::place::{Section, name};
use super::{Options, Page, pictures, provenance, shell, table};
use crate::group::{check_all, places};
use crate::markup::Markup;
use crate::metric::METRICS;
use crate::model::{Point, Provenance};
use crate::number::{count, figure};
use crate::style::Styles;
use crate::svg::legend;
use shadowgraph_core::problem::Problems;

/// Writes the page.
///
/// # Errors
/// Points that cannot be charted ([`crate::check`]) or share an id, all of them.
pub fn charts(points: &[Point], options: &Options) -> Result<Page, Problems> {
    check_all(points)?;
    let styles = Styles::of_points(points);
    let places = places(points);
    let sections: Vec<Section> =
        places.iter().map(|(place, points)| Section::new(place, points, &styles, options.front)).collect();
    let mut album = Album::new(options.picture, options.pictures_max_bytes);
    for wanted in 0..3 {
        for (_, point) in sections.iter().flat_map(Section::ranked).filter(|(rank, _)| *rank == wanted) {
            pictures::admit(&mut album, point);
        }
    }
    let html = shell::document(options.title, |markup| {
        markup.open("header", &[]).element("h1", &[], options.title);
        if !options.about.is_empty() {
            markup.element("p", &[], options.about);
        }
        let provenances: Vec<&Provenance> = points.iter().map(|point| &point.provenance).collect();
        provenance::head(markup, &provenances);
        markup.close().line();
        controls(markup, &sections, points, &styles);
        markup.open("main", &[]).line();
        summary(markup, &sections);
        for (index, section) in sections.iter().enumerate() {
            section.write(markup, index, &styles, &album, options.front);
        }
        failures(markup, points);
        markup.open("section", &[("id", "sources")]).element("h2", &[], "Where every point comes from");
        markup.open("details", &[]).element("summary", &[], &format!("{} points", count(points.len() as u64)));
        provenance::table(markup, points);
        markup.close().close().close().line();
        album.write(markup);
    });
    Ok(Page { html, remarks: album.remarks })
}

fn controls(markup: &mut Markup, sections: &[Section], points: &[Point], styles: &Styles) {
    markup.open("nav", &[("aria-label", "What to show")]).line();
    markup.open("div", &[("class", "controls"), ("hidden", "hidden")]);
    let titles: Vec<String> = sections.iter().map(|section| section.place.title()).collect();
    let scenes = titles.iter().enumerate().map(|(index, title)| (format!("place-{index}"), title.as_str()));
    let all = ("all".to_string(), "all");
    shell::select(markup, "choose-place", "Scene", &scenes.chain([all]).collect::<Vec<_>>());
    let metrics: Vec<(String, &str)> = METRICS.iter().map(|metric| (metric.name.into(), metric.title)).collect();
    shell::select(markup, "choose-metric", "Error", &metrics);
    markup.close().line();
    methods(markup, points.iter().map(|point| point.graph.as_str()), styles);
    markup.close().line();
}

/// The legend, which a script turns into switches.
pub fn methods<'a>(markup: &mut Markup, graphs: impl Iterator<Item = &'a str>, styles: &Styles) {
    let mut graphs: Vec<&str> = graphs.collect();
    graphs.sort_by_key(|graph| styles.method(graph));
    graphs.dedup();
    markup.open("ul", &[("class", "legend")]);
    for graph in graphs {
        markup.open("li", &[("data-method", graph)]).raw(&legend::mark(styles, graph));
        markup.element("span", &[], graph).close();
    }
    if let Some(key) = styles.backend_key() {
        markup.element("li", &[("class", "note")], &key);
    }
    markup.close().line();
}

fn summary(markup: &mut Markup, sections: &[Section]) {
    markup.open("section", &[("id", "summary")]).element("h2", &[], "Summary").line();
    let columns = [
        ("scene", ""),
        ("variants", "variants that were measured"),
        ("failed", "variants that could not run"),
        ("error", "the error that the next columns are about"),
        ("fastest", ""),
        ("least error, fastest", "of all variants with the least error, the fastest"),
        ("on the front", ""),
    ];
    table::open(markup, "", &columns);
    for (index, section) in sections.iter().enumerate() {
        let measured = section.points.iter().filter(|point| point.failure.is_none());
        let figures = measured
            .clone()
            .filter_map(|point| Some((point.millis?.median, section.metric.of(&point.errors)?, *point)));
        let figures: Vec<(f64, f64, &Point)> = figures.collect();
        let fastest = figures.iter().min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let rightest = figures.iter().min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
        let place = format!("#place-{index}");
        markup.open("tr", &[]).open("th", &[("scope", "row")]);
        markup.element("a", &[("href", &place)], &section.place.title()).close();
        let measured = measured.count();
        table::number(markup, Some(measured as f64));
        table::number(markup, Some((section.points.len() - measured) as f64));
        table::text(markup, section.metric.title);
        for best in [fastest, rightest] {
            let text = best.map_or_else(
                || "–".into(),
                |(millis, error, point)| {
                    format!("{}: {} ms, {}", name(point, &section.points), figure(*millis), figure(*error))
                },
            );
            table::text_by(markup, best.map(|(millis, ..)| *millis), &text);
        }
        table::number(markup, Some(section.front.on.len() as f64));
        markup.close().line();
    }
    table::close(markup);
    markup.close().line();
}

fn failures(markup: &mut Markup, points: &[Point]) {
    markup.open("section", &[("id", "failures")]).element("h2", &[], "What could not run").line();
    let failed: Vec<(&Point, &String)> =
        points.iter().filter_map(|point| Some((point, point.failure.as_ref()?))).collect();
    if failed.is_empty() {
        markup.element("p", &[], "Every variant ran.");
    } else {
        table::open(markup, "", &["scene", "view", "variant", "on", "why"].map(|title| (title, "")));
        for (point, failure) in failed {
            markup.open("tr", &[("data-m", &point.graph)]);
            [&point.scene, &point.view, &point.label, &point.backend, failure]
                .iter()
                .for_each(|word| table::text(markup, word));
            markup.close().line();
        }
        table::close(markup);
    }
    markup.close().line();
}
