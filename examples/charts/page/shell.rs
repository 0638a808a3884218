//! What every page has: head, style, script, nothing from elsewhere.

use crate::markup::Markup;
use crate::style::dark_rules;

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Browsers hold the page to what it promises: nothing is fetched.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// A whole document around `body`.
pub fn document(title: &str, body: impl FnOnce(&mut Markup)) -> String {
    let mut markup = Markup::default();
    markup.raw("<!DOCTYPE html>\n").open("html", &[("lang", "en")]).open("head", &[]).line();
    markup.leaf("meta", &[("charset", "utf-8")]).line();
    markup.leaf("meta", &[("http-equiv", "Content-Security-Policy"), ("content", POLICY)]).line();
    markup.leaf("meta", &[("name", "viewport"), ("content", "width=device-width, initial-scale=1")]).line();
    markup.leaf("meta", &[("name", "color-scheme"), ("content", "light dark")]).line();
    markup.element("title", &[], title).line();
    markup.open("style", &[]).raw("\n").raw(STYLE);
    markup.raw("@media screen and (prefers-color-scheme: dark) {\n").raw(&dark_rules()).raw("\n}\n").close().line();
    markup.close().line().open("body", &[]).line();
    body(&mut markup);
    markup.open("script", &[]).raw("\n").raw(SCRIPT).close().line();
    markup.close().close().line();
    markup.finish()
}

/// A selector that a script shows and serves.
pub fn select(markup: &mut Markup, id: &str, label: &str, options: &[(String, &str)]) {
    markup.open("label", &[]).text(label).text(" ").open("select", &[("id", id)]);
    for (value, title) in options {
        markup.element("option", &[("value", value)], title);
    }
    markup.close().close().line();
}
