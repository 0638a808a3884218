//! The table of methods and cases: what holds, what fails, what was expected.

use crate::group::Case;
use crate::markup::Markup;
use crate::model::{Expected, Stability, Verdict};
use crate::number::{figure, figure_or_dash};
use crate::style::Styles;
use crate::svg::heat::{Cell, Standing};
use crate::svg::legend;

/// A method as a column: label and backend.
pub type Column<'a> = (&'a str, &'a str);

/// Columns in the order of legends, each once.
pub fn columns<'a>(records: &'a [Stability], styles: &Styles) -> Vec<(&'a str, Column<'a>)> {
    let mut columns: Vec<(&str, Column)> = records
        .iter()
        .map(|record| (record.graph.as_str(), (record.label.as_str(), record.backend.as_str())))
        .collect();
    columns.sort_by_key(|(graph, column)| (styles.method(graph), *column));
    columns.dedup();
    columns
}

/// Heading of a column.
pub fn heading((label, backend): Column, styles: &Styles) -> String {
    if styles.backend_key().is_some() { format!("{label} ({backend})") } else { label.into() }
}

/// What a record says in a few letters, and in full.
pub fn cell(record: &Stability) -> Cell {
    let figure = record.figure.map(figure);
    let (standing, text) = match &record.verdict {
        Verdict::Holds => (Standing::Holds, format!("✓ {}", figure.unwrap_or_default())),
        Verdict::Fails => (Standing::Fails, format!("✗ {}", figure.unwrap_or_default())),
        Verdict::NotRun { .. } => (Standing::Unknown, "not run".into()),
    };
    let marked = record.verdict.surprises(record.expected);
    Cell { standing, text, marked, tooltip: story(record) }
}

/// One cell for all records of a case in one column: the gravest of them. Without any, nothing is known.
pub fn summary_cell(records: &[&Stability], (graph, column): (&str, Column)) -> Cell {
    let cells: Vec<Cell> = of_column(records, graph, column).map(cell).collect();
    let gravest = cells.iter().max_by_key(|cell| cell.standing).cloned().unwrap_or_default();
    let tooltips: Vec<&str> = cells.iter().map(|cell| cell.tooltip.as_str()).collect();
    Cell { marked: cells.iter().any(|cell| cell.marked), tooltip: tooltips.join("\n"), ..gravest }
}

fn of_column<'a>(
    records: &[&'a Stability],
    graph: &str,
    (label, backend): Column,
) -> impl Iterator<Item = &'a Stability> {
    let is_here =
        move |record: &&Stability| record.graph == graph && record.label == label && record.backend == backend;
    records.iter().copied().filter(is_here)
}

/// The record in a sentence or two.
pub fn story(record: &Stability) -> String {
    let judged = match &record.verdict {
        Verdict::NotRun { why } => format!("not run: {why}"),
        verdict => {
            let word = if *verdict == Verdict::Holds { "holds" } else { "fails" };
            let threshold = figure_or_dash(record.threshold);
            format!("{word}: {} {}, threshold {threshold}", record.judged_by, figure_or_dash(record.figure))
        }
    };
    let source = if record.expected_source.is_empty() { "no source given" } else { &record.expected_source };
    format!("{} ({}) {judged}. Theory: {} ({source}).", record.label, record.backend, record.expected.title())
}

/// The table as HTML. Every record is in exactly one cell.
pub fn table(markup: &mut Markup, cases: &[(Case, Vec<&Stability>)], columns: &[(&str, Column)], styles: &Styles) {
    markup.open("div", &[("class", "scroll"), ("tabindex", "0")]).open("table", &[("class", "matrix")]);
    markup.open("thead", &[]).open("tr", &[]).element("th", &[("scope", "col")], "scene and sequence");
    for (graph, column) in columns {
        markup.open("th", &[("scope", "col"), ("data-m", graph)]).open("span", &[]);
        markup.raw(&legend::mark(styles, graph));
        // Names may break behind an underscore, and nowhere else.
        for (index, part) in heading(*column, styles).split('_').enumerate() {
            if index > 0 {
                markup.text("_").leaf("wbr", &[]);
            }
            markup.text(part);
        }
        markup.close().close();
    }
    markup.close().close().open("tbody", &[]).line();
    for (index, (case, records)) in cases.iter().enumerate() {
        let link = format!("#case-{index}");
        markup.open("tr", &[]).open("th", &[("scope", "row")]);
        markup.element("a", &[("href", &link)], &case.title()).close();
        for (graph, column) in columns {
            let summary = summary_cell(records, (graph, *column));
            let mut here = of_column(records, graph, *column).peekable();
            let standing = if here.peek().is_some() { summary.standing.class() } else { "none" };
            let class = if summary.marked { format!("{standing} surprise") } else { standing.into() };
            markup.open("td", &[("class", &class), ("title", &summary.tooltip), ("data-m", graph)]);
            for record in here {
                let cell = cell(record);
                markup.element("b", &[], &cell.text);
                let differs = if cell.marked { "≠ " } else { "" };
                markup.element("small", &[], &format!("{differs}{}", short(record.expected)));
            }
            markup.close();
        }
        markup.close().line();
    }
    markup.close().close().close().line();
}

fn short(expected: Expected) -> &'static str {
    match expected {
        Expected::MustHold => "must hold",
        Expected::ExpectedToFail => "must fail",
        Expected::Open => "open",
    }
}
