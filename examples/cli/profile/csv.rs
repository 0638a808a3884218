//! A profile as comma-separated values: a row for each node, and one for whole frames.

use super::Profile;
use super::times::{Readings, Series, Times};

const HEADER: &[&str] = &[
    "graph",
    "graph_hash",
    "scene",
    "adapter",
    "node",
    "stage",
    "pass",
    "on",
    "clock",
    "measured",
    "count",
    "median_millis",
    "p5_millis",
    "p95_millis",
    "p99_millis",
    "min_millis",
    "max_millis",
    "zero_count",
    "negative_count",
    "dropped_count",
    "untimed_count",
    "disagrees",
    "bytes",
    "scratch_bytes",
    "counts",
];

/// The table. Counts are `name=value` separated by blanks; what is not known is empty.
pub fn text(profile: &Profile) -> String {
    let mut text = row(HEADER.iter().map(|name| name.to_string()));
    let cold = &profile.cold;
    let adapter = if cold.device.adapter.is_empty() { "cpu" } else { &cold.device.adapter };
    let start = [cold.graph.clone(), cold.graph_hash.clone(), cold.scene.name.clone(), adapter.to_string()];
    for node in &profile.nodes {
        let on = format!("{:?}", node.on).to_lowercase();
        let what = [node.node.clone(), node.stage.into(), node.pass.into(), on, node.clock.into()];
        let counts: Vec<String> = node.counts.iter().map(|(name, count)| format!("{name}={count}")).collect();
        let scratch = node.scratch_bytes.map(|bytes| bytes.to_string()).unwrap_or_default();
        let end = [node.disagrees.to_string(), node.bytes.to_string(), scratch, counts.join(" ")];
        for (measured, series) in [("in_frame", Some(&node.in_frame)), ("alone", node.alone.as_ref())] {
            let Some(series) = series else { continue };
            let cells = start.iter().chain(&what).cloned().chain([measured.to_string()]);
            text.push_str(&row(cells.chain(numbers(series)).chain(end.iter().cloned())));
        }
    }
    for (measured, times) in [("frame_timers_off", profile.frame), ("frame_timers_on", profile.timed_frame)] {
        if times.is_some() {
            let series = Series { times, readings: Readings::default() };
            let cells = start.iter().cloned().chain(["", "", "", "", "host clock"].map(String::from));
            let cells = cells.chain([measured.to_string()]).chain(numbers(&series));
            text.push_str(&row(cells.chain(["", "", "", ""].map(String::from))));
        }
    }
    text
}

fn numbers(series: &Series) -> Vec<String> {
    let mut cells = match series.times {
        None => {
            vec!["0".into(), String::new(), String::new(), String::new(), String::new(), String::new(), String::new()]
        }
        Some(Times { count, median, p5, p95, p99, min, max }) => {
            let mut cells = vec![count.to_string()];
            cells.extend([median, p5, p95, p99, min, max].map(|millis| millis.to_string()));
            cells
        }
    };
    let Readings { zero_count, negative_count, dropped_count, untimed_count, .. } = series.readings;
    cells.extend([zero_count, negative_count, dropped_count, untimed_count].map(|count| count.to_string()));
    cells
}

/// One line; cells that would break it are quoted (RFC 4180).
fn row(cells: impl Iterator<Item = String>) -> String {
    let quoted = |cell: String| match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    };
    cells.map(quoted).collect::<Vec<_>>().join(",") + "\r\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_would_break_a_row_are_quoted() {
        let cells = ["a,b", "say \"x\"", "two\nlines", "plain"].map(String::from);
        assert_eq!(row(cells.into_iter()), "\"a,b\",\"say \"\"x\"\"\",\"two\nlines\",plain\r\n");
    }
}
