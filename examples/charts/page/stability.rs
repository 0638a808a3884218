//! The page of a stability suite: where each method holds and where it breaks.

use super::album::Album;
use super::{Options, Page, case, charts::methods, matrix, pictures, provenance, shell, table};
use crate::group::{Case, cases, check_all};
use crate::markup::Markup;
use crate::metric::FRAME_FIGURES;
use crate::model::{Expected, Provenance, Stability, Verdict};
use crate::number::count;
use crate::style::Styles;
use shadowgraph_core::problem::Problems;

/// Writes the page.
///
/// # Errors
/// Records that cannot be charted ([`crate::check`]) or share an id, all of them.
pub fn stability(records: &[Stability], options: &Options) -> Result<Page, Problems> {
    check_all(records)?;
    let styles = Styles::of_stabilities(records);
    let cases = cases(records);
    let mut album = Album::new(options.picture, options.pictures_max_bytes);
    // Surprises tell most, then failures.
    let rank = |record: &Stability| match &record.verdict {
        verdict if verdict.surprises(record.expected) => 0,
        Verdict::Fails => 1,
        _ => 2,
    };
    for wanted in 0..3 {
        records.iter().filter(|record| rank(record) == wanted).for_each(|record| case::admit(&mut album, record));
    }
    let html = shell::document(options.title, |markup| {
        markup.open("header", &[]).element("h1", &[], options.title);
        if !options.about.is_empty() {
            markup.element("p", &[], options.about);
        }
        let provenances: Vec<&Provenance> = records.iter().map(|record| &record.provenance).collect();
        provenance::head(markup, &provenances);
        markup.close().line();
        controls(markup, &cases, records, &styles);
        markup.open("main", &[]).line();
        summary(markup, records);
        surprises(markup, &cases);
        markup.open("section", &[("id", "matrix")]).element("h2", &[], "Methods and failure scenes");
        matrix::table(markup, &cases, &matrix::columns(records, &styles), &styles);
        markup.element(
            "p",
            &[("class", "note")],
            "✓ holds, ✗ fails, each with the figure it was judged by; below it what theory says. ≠ and a frame: theory says otherwise.",
        );
        markup.close().line();
        if records.iter().any(|record| record.worst.as_ref().is_some_and(|worst| worst.error.is_some())) {
            pictures::scale(markup);
        }
        for (index, (case, records)) in cases.iter().enumerate() {
            case::write(markup, index, case, records, &styles, &album);
        }
        markup.close().line();
        album.write(markup);
    });
    Ok(Page { html, remarks: album.remarks })
}

fn controls(markup: &mut Markup, cases: &[(Case, Vec<&Stability>)], records: &[Stability], styles: &Styles) {
    markup.open("nav", &[("aria-label", "What to show")]).line();
    markup.open("div", &[("class", "controls"), ("hidden", "hidden")]);
    let titles: Vec<String> = cases.iter().map(|(case, _)| case.title()).collect();
    let scenes = titles.iter().enumerate().map(|(index, title)| (format!("case-{index}"), title.as_str()));
    let all = ("all".to_string(), "all");
    shell::select(markup, "choose-place", "Case", &std::iter::once(all).chain(scenes).collect::<Vec<_>>());
    let judged = ("".to_string(), "judged by");
    let figures = FRAME_FIGURES.iter().map(|figure| (figure.name.to_string(), figure.title));
    shell::select(markup, "choose-metric", "Figure", &std::iter::once(judged).chain(figures).collect::<Vec<_>>());
    markup.close().line();
    methods(markup, records.iter().map(|record| record.graph.as_str()), styles);
    markup.close().line();
}

fn summary(markup: &mut Markup, records: &[Stability]) {
    let number = |wanted: &dyn Fn(&Stability) -> bool| records.iter().filter(|record| wanted(record)).count() as u64;
    markup.open("section", &[("id", "summary")]).element("h2", &[], "Summary").line();
    let columns = ["theory", "records", "hold", "fail", "not run", "not as expected"];
    table::open(markup, "", &columns.map(|title| (title, "")));
    for expected in [Expected::MustHold, Expected::ExpectedToFail, Expected::Open] {
        let of = |wanted: &dyn Fn(&Stability) -> bool| Some(number(&|r| r.expected == expected && wanted(r)) as f64);
        markup.open("tr", &[]).element("th", &[("scope", "row")], expected.title());
        table::number(markup, of(&|_| true));
        table::number(markup, of(&|record| record.verdict == Verdict::Holds));
        table::number(markup, of(&|record| record.verdict == Verdict::Fails));
        table::number(markup, of(&|record| matches!(record.verdict, Verdict::NotRun { .. })));
        table::number(markup, of(&|record| record.verdict.surprises(record.expected)));
        markup.close().line();
    }
    table::close(markup);
    if number(&|record| record.verdict == Verdict::Fails) == 0 && !records.is_empty() {
        let warning = format!(
            "None of {} records fails: a suite in which nothing fails has not shown that it can see a failure.",
            count(records.len() as u64)
        );
        markup.element("p", &[("class", "failure")], &warning);
    }
    markup.close().line();
}

fn surprises(markup: &mut Markup, cases: &[(Case, Vec<&Stability>)]) {
    markup.open("section", &[("id", "surprises")]).element("h2", &[], "Not as expected").line();
    let found: Vec<(usize, &Case, &&Stability)> = cases
        .iter()
        .enumerate()
        .flat_map(|(index, (case, records))| records.iter().map(move |record| (index, case, record)))
        .filter(|(_, _, record)| record.verdict.surprises(record.expected))
        .collect();
    if found.is_empty() {
        markup.element("p", &[], "Every verdict agrees with what theory says.");
    } else {
        markup.open("ul", &[]);
        for (index, case, record) in found {
            let link = format!("#case-{index}");
            markup.open("li", &[("data-m", &record.graph)]).element("a", &[("href", &link)], &case.title());
            markup.text(": ").text(&matrix::story(record)).close().line();
        }
        markup.close();
    }
    markup.close().line();
}
