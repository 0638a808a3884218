//! A comparison as tables.

use super::Report;
use super::bisect::Found;
use super::timing::Timing;
use crate::report::{align_right, table};
use shadowgraph_charts::model::Errors;
use shadowgraph_measure::paired::{Summary, Verdict};
use shadowgraph_measure::statistics::sign_test;

/// All of it.
pub fn text(report: &Report) -> String {
    let [a, b] = [&report.a, &report.b].map(|[name, id]| format!("{name} [{id}]"));
    let mut text = format!("A: {a}\nB: {b}\non {}, {}x{} pixels", report.scene, report.size[0], report.size[1]);
    text += &match report.light_samples {
        [1, 1] => ", 1 light sample\n".into(),
        [a, b] if a == b => format!(", {a} light samples\n"),
        [a, b] => format!(", {a} light samples for A and {b} for B: bits cannot be compared between them\n"),
    };
    text += "\nWhat differs between the graphs\n";
    if report.differences.is_empty() {
        text += "  nothing\n";
    }
    for difference in &report.differences {
        text += &format!("  {}\n", difference.text());
    }
    text += &ports_text(report);
    if let Some(errors) = &report.errors {
        text += &errors_text(errors);
        if let (Some(count), [a, b]) = (report.truth_light_samples, report.light_samples)
            && a != b
        {
            text += &format!(
                "visible fractions and pictures of both against {count} light samples, bits against each one's own light samples\n"
            );
        }
    }
    if !report.blames.is_empty() || !report.not_attributed.is_empty() {
        text += &blames_text(report);
    }
    if let Some(timing) = &report.timing {
        text += &timing_text(timing, report);
    }
    text
}

fn ports_text(report: &Report) -> String {
    let mut text = String::from("\nValues of nodes that both have\n");
    if !report.shared.is_empty() {
        text += &format!("  taken over from A, as node and inputs are the same: {}\n", report.shared.join(", "));
    }
    let mut rows = table(&["port", "inputs", "comparison"]);
    for row in &report.ports {
        let inputs = if row.inputs_are_equivalent { "equivalent" } else { "differ" };
        rows.add_row([format!("{}.{}", row.node, row.port), inputs.into(), row.comparison.text()]);
    }
    if !report.ports.is_empty() {
        text += &format!("{rows}\n");
    }
    text += &match &report.first_difference {
        Some(node) => format!("first node that differs: {node}\n"),
        None => match report.ports.iter().find(|row| !row.comparison.is_equivalent()) {
            None => "no node differs\n".into(),
            Some(row) => format!(
                "no node makes other values of the same inputs; the first that are not the same: {}.{}\n",
                row.node, row.port
            ),
        },
    };
    for row in report.ports.iter().filter(|row| row.is_fault()) {
        text += &format!("NOT AS ITS CONTRACT ALLOWS: {}.{}: {}\n", row.node, row.port, row.comparison.text());
    }
    text
}

/// A figure with three digits; `-` where there is none.
pub fn figure(value: Option<f64>) -> String {
    match value {
        None => "-".into(),
        Some(0.0) => "0".into(),
        Some(value) if (0.001..1000.0).contains(&value.abs()) => format!("{value:.4}"),
        Some(value) => format!("{value:.2e}"),
    }
}

/// One of the errors.
type Figure = fn(&Errors) -> Option<f64>;

fn errors_text(errors: &[Errors; 2]) -> String {
    let mut rows = table(&["error against the truth", "A", "B"]);
    let figures: [(&str, Figure); 11] = [
        ("wrong bits, share", |errors| errors.wrong_bit_share),
        ("light leak, share", |errors| errors.light_leak_share),
        ("shadow leak, share", |errors| errors.shadow_leak_share),
        ("RMSE of visibility, true penumbra", |errors| errors.rmse_penumbra),
        ("RMSE of visibility, all", |errors| errors.rmse_all),
        ("99th percentile of the error", |errors| errors.p99),
        ("largest error", |errors| errors.max),
        ("mean error, above 0 too light", |errors| errors.mean_signed),
        ("penumbra width over true width", |errors| errors.penumbra_width_ratio),
        ("mean FLIP, tone-mapped", |errors| errors.flip_tonemapped),
        ("mean HDR-FLIP, linear", |errors| errors.flip_linear),
    ];
    for (name, of) in figures {
        rows.add_row([name.to_string(), figure(of(&errors[0])), figure(of(&errors[1]))]);
    }
    align_right(&mut rows, &[1, 2]);
    format!("\n{rows}\n")
}

fn blames_text(report: &Report) -> String {
    let mut rows = table(&["node of B made right", "error that goes away", "wrong bits left", "RMSE left"]);
    for blame in &report.blames {
        let share = blame.removed_share.map_or("no error".into(), |share| format!("{:.1} %", share * 100.0));
        rows.add_row([blame.node.clone(), share, figure(blame.errors.wrong_bit_share), figure(blame.errors.rmse_all)]);
    }
    align_right(&mut rows, &[1, 2, 3]);
    let mut text = if report.blames.is_empty() { String::new() } else { format!("\n{rows}\n") };
    if !report.not_attributed.is_empty() {
        let nodes = report.not_attributed.join(", ");
        text += &format!(
            "not attributed, as the truth has no other values for them or no answer comes from them: {nodes}\n"
        );
    }
    text
}

fn timing_text(timing: &Timing, report: &Report) -> String {
    let mut rows = table(&["node", "A ms", "B ms", "B / A", "interval", "verdict"]);
    let millis = |millis: Option<f64>| millis.map_or("-".into(), |millis| format!("{millis:.3}"));
    for node in &timing.nodes {
        let [ratio, interval, verdict] = summary_cells(node.summary.as_ref());
        rows.add_row([node.node.clone(), millis(node.a_millis), millis(node.b_millis), ratio, interval, verdict]);
    }
    let frame = &timing.frame;
    let [ratio, interval, verdict] = summary_cells(Some(frame));
    let (a, b) = (Some(frame.a_millis.median), Some(frame.b_millis.median));
    rows.add_row(["whole frame".into(), millis(a), millis(b), ratio, interval, verdict]);
    align_right(&mut rows, &[1, 2, 3, 4]);
    let software =
        if report.device.adapter_type.eq_ignore_ascii_case("cpu") { " on a software rasteriser" } else { "" };
    let each = if timing.frames_count > 1 {
        format!(", each timing of {} frames", timing.frames_count)
    } else {
        String::new()
    };
    format!(
        "\n{rows}\n{} blocks of four timings{each}, whole frames with node timers off{software}; nodes by {}\nB is {}: \
         ratio {:.4}, {:.4} to {:.4} at {} % (spread of a block {:.1} %); verdict at {} %, threshold {} %\n",
        frame.blocks_count,
        timing.nodes_clock,
        verdict_word(frame),
        frame.ratio,
        frame.interval.low,
        frame.interval.high,
        percent(frame.confidence),
        frame.spread * 100.0,
        percent(frame.verdict_confidence),
        percent(frame.threshold),
    ) + &too_short(timing)
}

/// A verdict needs blocks enough for a sign test at its confidence.
fn too_short(timing: &Timing) -> String {
    let least =
        (1..).find(|count| sign_test(*count, *count) <= (1.0 - timing.frame.verdict_confidence) / 2.0).unwrap_or(0);
    match timing.frame.blocks_count {
        count if count < least => {
            format!(
                "{count} blocks are too few for a verdict, which takes {least}: give it more --seconds or --blocks\n"
            )
        }
        _ => String::new(),
    }
}

fn percent(share: f64) -> f64 {
    (share * 1e6).round() / 1e4
}

fn verdict_word(summary: &Summary) -> &'static str {
    match summary.verdict {
        Verdict::Faster => "FASTER",
        Verdict::Slower => "SLOWER",
        Verdict::Undecided if summary.equivalent => "as fast, within the threshold",
        Verdict::Undecided => "undecided",
    }
}

fn summary_cells(summary: Option<&Summary>) -> [String; 3] {
    let Some(summary) = summary else { return ["-".into(), "-".into(), "-".into()] };
    [
        format!("{:.3}", summary.ratio),
        format!("{:.3} .. {:.3}", summary.interval.low, summary.interval.high),
        match summary.verdict {
            Verdict::Undecided if summary.equivalent => "equal".into(),
            Verdict::Undecided => "undecided".into(),
            _ => verdict_word(summary).to_lowercase(),
        },
    ]
}

/// The search for the node that makes two backends differ.
pub fn bisect_text(found: &Found) -> String {
    let mut rows = table(&["on wgpu up to", found.output.as_str()]);
    for step in &found.steps {
        rows.add_row([step.up_to.clone(), step.comparison.text()]);
    }
    let mut text = format!("{rows}\nview-samples: the CPU's, for both\n");
    if !found.on_one_backend.is_empty() {
        text += &format!("no suspects, as they run on one backend only: {}\n", found.on_one_backend.join(", "));
    }
    match &found.node {
        None => text += "the backends agree\n",
        Some(node) => {
            text += &format!("the answer begins to differ with node: {node}\n");
            for (port, comparison) in &found.ports {
                text += &format!("  by itself, on the CPU's inputs: {port}: {}\n", comparison.text());
            }
        }
    }
    text
}
