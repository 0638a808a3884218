//! Tables that a script can sort: every cell carries what it is sorted by.

use crate::markup::Markup;
use crate::number::{figure, figure_or_dash};

/// A column: title, and what it means where the title does not say.
pub type Column<'a> = (&'a str, &'a str);

/// Opens a table up to its first row.
pub fn open(markup: &mut Markup, caption: &str, columns: &[Column]) {
    markup.open("div", &[("class", "scroll"), ("tabindex", "0")]).open("table", &[("class", "sortable")]);
    if !caption.is_empty() {
        markup.element("caption", &[], caption);
    }
    markup.open("thead", &[]).open("tr", &[]);
    for (title, hint) in columns {
        let attributes = [("scope", "col"), ("title", *hint)];
        markup.element("th", &attributes[..if hint.is_empty() { 1 } else { 2 }], title);
    }
    markup.close().close().open("tbody", &[]).line();
}

/// Closes what `open` opened.
pub fn close(markup: &mut Markup) {
    markup.close().close().close().line();
}

/// A cell of text.
pub fn text(markup: &mut Markup, text: &str) {
    markup.element("td", &[], text);
}

/// A figure, sorted by its value; a dash sorts last.
pub fn number(markup: &mut Markup, value: Option<f64>) {
    number_as(markup, value, &figure_or_dash(value));
}

/// A figure with a text of its own.
pub fn number_as(markup: &mut Markup, value: Option<f64>, text: &str) {
    let value = value.map_or_else(|| "Infinity".into(), |value| value.to_string());
    markup.element("td", &[("class", "n"), ("data-v", &value)], text);
}

/// A text, sorted by a value.
pub fn text_by(markup: &mut Markup, value: Option<f64>, text: &str) {
    let value = value.map_or_else(|| "Infinity".into(), |value| value.to_string());
    markup.element("td", &[("data-v", &value)], text);
}

/// A time with its interval.
pub fn millis(markup: &mut Markup, time: Option<crate::model::Interval>) {
    let text = time.map(|time| format!("{} [{}, {}]", figure(time.median), figure(time.low), figure(time.high)));
    number_as(markup, time.map(|time| time.median), &text.unwrap_or_else(|| "–".into()));
}
