//! A profile for people.

use super::times::{Readings, Series, Times};
use super::{NodeProfile, Profile};
use crate::report::{align_right, bytes_text, heading_text, left_out_text, table};

/// Counts that are a part of another: what is shown as a share.
const PARTS: &[(&str, &str)] = &[
    ("blocking_pairs", "pairs"),
    ("cut_pairs", "pairs"),
    ("exact_pairs", "pairs"),
    ("lit_shafts", "shafts"),
    ("covered_shafts", "shafts"),
    ("patch_shafts", "shafts"),
];

/// Heading, tables, counts, and what is to be known of the clocks.
pub fn text(profile: &Profile) -> String {
    let mut text = heading_text(&profile.cold);
    if profile.clocks.timers {
        text.push_str(&nodes_table(profile));
    }
    text.push_str(&counts_text(profile));
    text.push_str(&frames_text(profile));
    text.push_str(&clocks_text(profile));
    for why in &profile.not_measured {
        text.push_str(&format!("not measured: {why}\n"));
    }
    text + &left_out_text(&profile.cold)
}

fn nodes_table(profile: &Profile) -> String {
    let mut table = table(&[
        "node", "pass", "on", "in frame", "P95", "P99", "min", "max", "share", "alone", "P95", "", "made", "scratch",
    ]);
    let median = |node: &NodeProfile| node.in_frame.times.map_or(0.0, |times| times.median);
    let total: f64 = profile.nodes.iter().map(median).sum();
    for node in &profile.nodes {
        let pass = if node.stage == node.node { node.pass.into() } else { format!("{}/{}", node.stage, node.pass) };
        let share = if total > 0.0 { format!("{:.0} %", 100.0 * median(node) / total) } else { String::new() };
        let [middle, p95, p99, min, max] = cells(&node.in_frame);
        let [alone, alone_p95, ..] = node.alone.as_ref().map(cells).unwrap_or_default();
        let flag = if node.disagrees { "!" } else { "" };
        table.add_row([
            node.node.clone(),
            pass,
            format!("{:?}", node.on).to_lowercase(),
            middle,
            p95,
            p99,
            min,
            max,
            share,
            alone,
            alone_p95,
            flag.into(),
            bytes_text(node.bytes),
            node.scratch_bytes.map(|bytes| bytes_text(bytes as usize)).unwrap_or_default(),
        ]);
    }
    align_right(&mut table, &[3, 4, 5, 6, 7, 8, 9, 10, 12, 13]);
    let mut text = format!("{table}\n");
    let disagree: Vec<&str> =
        profile.nodes.iter().filter(|node| node.disagrees).map(|node| node.node.as_str()).collect();
    if !disagree.is_empty() {
        text.push_str(&format!(
            "!: in frame and alone differ by more than either spreads (P5 to P95): {}\n",
            disagree.join(", ")
        ));
    }
    text
}

/// Median, P95, P99, smallest, largest; what there is instead where no reading is good.
fn cells(series: &Series) -> [String; 5] {
    let number = |millis: f64| format!("{millis:.3}");
    match series.times {
        Some(Times { median, p95, p99, min, max, .. }) => [median, p95, p99, min, max].map(number),
        None => {
            let Readings { zero_count, negative_count, dropped_count, .. } = series.readings;
            let what = match (zero_count, negative_count, dropped_count) {
                (0, 0, 0) => "untimed",
                (0, 0, _) => "dropped",
                (_, 0, _) => "zero",
                _ => "negative",
            };
            [what.into(), String::new(), String::new(), String::new(), String::new()]
        }
    }
}

fn counts_text(profile: &Profile) -> String {
    let mut text = String::new();
    for node in &profile.nodes {
        let share = |name: &str, count: u64| {
            let (_, whole) = PARTS.iter().find(|(part, whole)| {
                *part == name && node.counts.iter().any(|(other, count)| other == whole && *count > 0)
            })?;
            let (_, all) = node.counts.iter().find(|(other, _)| other == whole)?;
            Some(format!(" ({:.1} % of {whole})", 100.0 * count as f64 / *all as f64))
        };
        let one = |(name, count): &(&str, u64)| format!("{name} {count}{}", share(name, *count).unwrap_or_default());
        let mut parts: Vec<String> = node.counts.iter().map(one).collect();
        if let Some(counted) = &node.statistics {
            let shaders = [
                ("vertex", counted.vertex_invocations),
                ("fragment", counted.fragment_invocations),
                ("compute", counted.compute_invocations),
                ("clipped in", counted.clipper_invocations),
                ("clipped out", counted.clipper_primitives),
            ];
            let ran = shaders.iter().filter(|(_, count)| *count > 0).map(|(what, count)| format!("{what} {count}"));
            let ran: Vec<String> = ran.collect();
            parts.push(format!("shaders ran: {}", if ran.is_empty() { "none".into() } else { ran.join(", ") }));
        }
        if !parts.is_empty() {
            text.push_str(&format!("counts of {}: {}\n", node.node, parts.join(", ")));
        }
    }
    text
}

fn frames_text(profile: &Profile) -> String {
    let one = |what: &str, times: Option<Times>| match times {
        None => String::new(),
        Some(Times { count, median, p95, p99, min, max, .. }) => {
            format!("{count} {what}: median {median:.3} ms, P95 {p95:.3}, P99 {p99:.3}, {min:.3} to {max:.3}\n")
        }
    };
    let mut text =
        one("whole frames, timers off", profile.frame) + &one("whole frames, timers on", profile.timed_frame);
    let cold = profile.cold.frame_millis.median;
    text.push_str(&format!(
        "one cold frame and {} warm ones came before; the cold one took {cold:.3} ms\n",
        profile.warm_up_count
    ));
    if let Some(overlap) = profile.overlap {
        text.push_str(&format!(
            "nodes added up {:.3} ms, first begin to last end {:.3} ms: overlap {:.3} ms, between nodes {:.3} ms (medians)\n",
            overlap.sum_millis, overlap.span_millis, overlap.overlapping_millis, overlap.gaps_millis
        ));
    }
    if let Some(bytes) = profile.memory_bytes {
        text.push_str(&format!("device memory: {}\n", bytes_text(bytes as usize)));
    }
    text
}

fn clocks_text(profile: &Profile) -> String {
    let clocks = &profile.clocks;
    let mut text = String::new();
    match clocks.has_timestamps {
        Some(true) => text.push_str("the device has timestamps\n"),
        Some(false) => text.push_str("the device has no timestamps: nodes are timed by the host\n"),
        None => {}
    }
    if clocks.is_software_rasteriser {
        text.push_str(
            "software rasteriser: the adapter is a program on the CPU; these are not times of a GPU, and its own timestamps are not used\n",
        );
    }
    if !clocks.timers {
        text.push_str("timers off: no node was timed\n");
        return text;
    }
    text.push_str(&format!("clock: {}\n", clocks.node_clocks.join("; ")));
    text.push_str(&format!("readings in frames: {}\n", readings_text(clocks.in_frame)));
    if clocks.alone != Readings::default() {
        text.push_str(&format!("readings alone: {}\n", readings_text(clocks.alone)));
    }
    if let Some(cost) = &clocks.cost {
        let interval = cost.interval.map(|interval| format!(" ({:.4} to {:.4} at 95 %)", interval.low, interval.high));
        text.push_str(&format!(
            "timers cost {:.4} ms a frame{}, {:.1} %: {}\n",
            cost.millis,
            interval.unwrap_or_default(),
            100.0 * cost.share,
            cost.how
        ));
    }
    text
}

fn readings_text(readings: Readings) -> String {
    let Readings { spans_count, zero_count, negative_count, dropped_count, untimed_count } = readings;
    format!(
        "{spans_count} good, {zero_count} zero, {negative_count} negative, {dropped_count} dropped, {untimed_count} untimed"
    )
}
