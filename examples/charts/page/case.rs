//! One failure scene along one sequence: lines, figures, the failing places.

use super::album::Album;
use super::matrix::story;
use super::place::not_shown;
use super::table;
use crate::group::Case;
use crate::markup::Markup;
use crate::metric::{FRAME_FIGURES, FrameFigure};
use crate::model::{Stability, StabilityFrame, Verdict, Worst};
use crate::number::figure;
use crate::style::Styles;
use crate::svg::legend;
use crate::svg::sequence::{Lines, lines};

/// Takes in the pictures of a record's failing place.
pub fn admit(album: &mut Album, record: &Stability) {
    let worst = record.worst.iter();
    worst.flat_map(|worst| [&worst.picture, &worst.truth, &worst.error]).flatten().for_each(|name| album.admit(name));
}

/// The section.
pub fn write(markup: &mut Markup, index: usize, case: &Case, records: &[&Stability], styles: &Styles, album: &Album) {
    let id = format!("case-{index}");
    markup.open("section", &[("class", "place"), ("id", &id)]).element("h2", &[], &case.title()).line();
    let mut records = records.to_vec();
    records.sort_by_key(|record| styles.method(&record.graph));
    let most = records.iter().map(|record| record.frames.len()).max().unwrap_or(0);
    if most > 1 {
        charts(markup, case, &records, styles);
    } else {
        let what = if most == 1 { "One frame: its figures are in the table." } else { "No method ran here." };
        markup.element("p", &[("class", "note")], what);
    }
    figures(markup, &records, styles);
    places(markup, &records, album);
    markup.close().line();
}

/// The figure that most records are judged by comes first and open.
fn charts(markup: &mut Markup, case: &Case, records: &[&Stability], styles: &Styles) {
    let has = |of: &dyn Fn(&StabilityFrame) -> bool| records.iter().any(|record| record.frames.iter().any(of));
    let mut figures: Vec<_> = FRAME_FIGURES.iter().filter(|f| has(&|frame| f.of(frame).is_some())).collect();
    figures.sort_by_key(|f| std::cmp::Reverse(records.iter().filter(|record| record.judged_by == f.name).count()));
    for (position, figure) in figures.iter().enumerate() {
        if position == 1 {
            markup.open("details", &[("class", "others")]).element("summary", &[], "Other figures").line();
        }
        let title = case.title();
        let chart = lines(&Lines { title: &title, records, figure, styles, with_legend: false });
        markup.open("div", &[("class", "against"), ("data-metric", figure.name)]);
        markup.open("figure", &[("class", "chart-box scroll"), ("tabindex", "0")]).raw(&chart.svg).close();
        markup.open("div", &[("class", "ranks")]);
        failing_from(markup, figure, records, styles);
        let label = |id: &str| records.iter().find(|r| r.id == id).map_or_else(|| id.into(), |r| r.label.clone());
        not_shown(markup, "Not in this chart", &chart.not_shown, label);
        markup.close().close().line();
    }
    if figures.len() > 1 {
        markup.close().line();
    }
}

/// Where along the sequence those begin to fail that this figure judges.
fn failing_from(markup: &mut Markup, judge: &FrameFigure, records: &[&Stability], styles: &Styles) {
    let fails = |record: &Stability, frame: &StabilityFrame| {
        judge.of(frame).zip(record.threshold).is_some_and(|(value, threshold)| value > threshold)
    };
    let failing = records.iter().filter(|record| record.judged_by == judge.name && record.verdict == Verdict::Fails);
    let failing: Vec<_> = failing
        .filter_map(|record| Some((record, record.frames.iter().position(|frame| fails(record, frame))?)))
        .collect();
    if failing.is_empty() {
        return;
    }
    markup.element("h4", &[], "Above its threshold").open("ul", &[("class", "plain")]);
    for (record, first) in failing {
        let unit = if record.unit.is_empty() { String::new() } else { format!(" {}", record.unit) };
        let value = figure(record.frames[first].value);
        let above = record.frames.iter().filter(|frame| fails(record, frame)).count();
        let text = format!(
            "{}: first at {} {value}{unit}, in {above} of {} frames",
            record.label,
            record.parameter,
            record.frames.len()
        );
        markup.open("li", &[("data-m", &record.graph)]).raw(&legend::mark(styles, &record.graph)).text(&text).close();
    }
    markup.close().line();
}

fn figures(markup: &mut Markup, records: &[&Stability], styles: &Styles) {
    let columns = [
        ("method", ""),
        ("on", "backend"),
        ("verdict", ""),
        ("figure", "the figure it was judged by"),
        ("judged by", ""),
        ("threshold", "above it, it fails"),
        ("theory", "what theory says, and where"),
        ("worst at", "value of the parameter in the worst frame"),
        ("pixel", "from the top left"),
        ("T-RMSE", "root mean square of the step of the visible fraction minus the truth's step"),
        ("toggling bits", "bits that toggle where the truth's do not, over bits compared in all steps"),
        ("slowest ms", "the slowest frame"),
        ("longest list", "most entries of any list in any frame"),
    ];
    table::open(markup, "", &columns);
    for record in records {
        let surprise = record.verdict.surprises(record.expected);
        markup.open("tr", &[("data-m", &record.graph)]).open("th", &[("scope", "row")]);
        markup.raw(&legend::mark(styles, &record.graph)).text(&record.label).close();
        table::text(markup, &record.backend);
        let (class, verdict) = match &record.verdict {
            Verdict::Holds => ("holds", "✓ holds".to_string()),
            Verdict::Fails => ("fails", "✗ fails".to_string()),
            Verdict::NotRun { why } => ("unknown", format!("not run: {why}")),
        };
        let class = if surprise { format!("{class} surprise") } else { class.into() };
        markup.element("td", &[("class", &class)], &verdict);
        table::number(markup, record.figure);
        table::text(markup, &record.judged_by);
        table::number(markup, record.threshold);
        let differs = if surprise { "≠ " } else { "" };
        let theory = match record.expected_source.as_str() {
            "" => format!("{differs}{}", record.expected.title()),
            source => format!("{differs}{}: {source}", record.expected.title()),
        };
        markup.element("td", &[("class", "theory")], &theory);
        let worst = record.worst.as_ref();
        let value = worst.and_then(|worst| record.frames.get(worst.frame)).map(|frame| frame.value);
        table::number(markup, value);
        let pixel = worst.map_or_else(|| "–".into(), |worst| format!("{}, {}", worst.pixel[0], worst.pixel[1]));
        table::text(markup, &pixel);
        let temporal = record.temporal.unwrap_or_default();
        table::number(markup, temporal.t_rmse);
        table::number(markup, temporal.toggled_share);
        table::number(markup, record.frames.iter().filter_map(|frame| frame.millis).reduce(f64::max));
        table::number(markup, record.frames.iter().filter_map(|f| f.longest_list_count).max().map(|n| n as f64));
        markup.close().line();
    }
    table::close(markup);
}

fn places(markup: &mut Markup, records: &[&Stability], album: &Album) {
    let pictured = |worst: &Worst| [&worst.picture, &worst.truth, &worst.error].iter().any(|name| name.is_some());
    let rows: Vec<(&&Stability, &Worst)> = records
        .iter()
        .filter_map(|record| Some((record, record.worst.as_ref()?)))
        .filter(|(_, w)| pictured(w))
        .collect();
    if rows.is_empty() {
        return;
    }
    markup.element("h3", &[], "Failing places").open("div", &[("class", "places")]).line();
    for (record, worst) in rows {
        markup.open("section", &[("class", "row"), ("data-m", &record.graph)]);
        let unit = if record.unit.is_empty() { String::new() } else { format!(" {}", record.unit) };
        let value = record.frames.get(worst.frame).map_or_else(String::new, |frame| figure(frame.value));
        let [x, y] = worst.pixel;
        let caption = format!("{}: {} {value}{unit}, pixel {x}, {y}", record.label, record.parameter);
        markup.element("h4", &[("title", &story(record))], &caption).open("div", &[("class", "three")]);
        for (name, what) in [(&worst.picture, "method"), (&worst.truth, "truth"), (&worst.error, "error")] {
            album.figure(markup, name.as_deref(), what, &format!("{what}: {caption}"));
        }
        markup.close().close().line();
    }
    markup.close().line();
}
