//! On what, from what, when: what all records share in the head of a page, what they do not in a table.

use super::table;
use crate::markup::Markup;
use crate::model::{Point, Provenance};
use crate::number::count;
use std::collections::BTreeMap;

/// Definitions for the head. A value that differs between records is given with the number of records that have it.
pub fn head(markup: &mut Markup, records: &[&Provenance]) {
    let device = |p: &Provenance| match (p.adapter.as_str(), p.adapter_type.as_str()) {
        ("", _) => format!("CPU, {} threads", p.threads),
        (adapter, "Cpu") => {
            format!("{adapter}, {} (a software rasteriser: its times say nothing about hardware)", p.driver)
        }
        (adapter, kind) => format!("{adapter}, {kind}, {}", p.driver),
    };
    let started: Vec<&str> = records.iter().map(|p| p.started.as_str()).filter(|text| !text.is_empty()).collect();
    let range = match (started.iter().min(), started.iter().max()) {
        (Some(first), Some(last)) if first == last => (*first).into(),
        (Some(first), Some(last)) => format!("{first} to {last}"),
        _ => String::new(),
    };
    markup.open("dl", &[("class", "provenance")]);
    entry(markup, "Program", values(records, |p| p.program_version.clone()));
    entry(markup, "Commit", values(records, |p| p.commit.clone()));
    entry(markup, "Device", values(records, device));
    entry(markup, "wgpu", values(records, |p| p.wgpu_version.clone()));
    entry(markup, "Measured", vec![or_unknown(range)]);
    markup.close().line();
}

fn entry(markup: &mut Markup, name: &str, values: Vec<String>) {
    markup.open("div", &[]).element("dt", &[], name);
    for value in values {
        markup.element("dd", &[], &value);
    }
    markup.close();
}

fn values(records: &[&Provenance], of: impl Fn(&Provenance) -> String) -> Vec<String> {
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for record in records {
        *counts.entry(or_unknown(of(record))).or_default() += 1;
    }
    let is_one = counts.len() == 1;
    let with_count = |(value, n): (String, u64)| if is_one { value } else { format!("{value} ({} records)", count(n)) };
    counts.into_iter().map(with_count).collect()
}

fn or_unknown(text: String) -> String {
    if text.is_empty() { "unknown".into() } else { text }
}

/// A row for each point.
pub fn table(markup: &mut Markup, points: &[Point]) {
    let columns =
        ["id", "scene", "view", "variant", "backend", "sets", "graph", "scene hash", "commit", "adapter", "started"];
    table::open(markup, "", &columns.map(|title| (title, "")));
    for point in points {
        let sets: Vec<String> = point.choices.iter().map(|(axis, value)| format!("{axis}={value}")).collect();
        let p = &point.provenance;
        markup.open("tr", &[("data-m", &point.graph)]);
        markup.open("td", &[]).element("code", &[], &point.id).close();
        let words = [&point.scene, &point.view, &point.label, &point.backend, &sets.join(" ")];
        words.iter().for_each(|word| table::text(markup, word));
        for hash in [&p.graph_hash, &p.scene_hash, &p.commit] {
            markup.open("td", &[]).element("code", &[], hash).close();
        }
        let adapter = if p.adapter.is_empty() { "–" } else { &p.adapter };
        table::text(markup, adapter);
        table::text(markup, &p.started);
        markup.close().line();
    }
    table::close(markup);
}
