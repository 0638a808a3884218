//! What the checks found, for people.

use super::{Check, Difference, Report, Verdict};
use crate::port_difference::Comparison;
use crate::report::{align_right, table};

/// A table of the checks, and a line for each difference.
pub fn text(report: &Report) -> String {
    let device = &report.device;
    let on = if device.backend == "cpu" { format!("CPU, {} threads", device.threads) } else { device.adapter.clone() };
    let [width, height] = report.size;
    let mut text = format!(
        "{} on {}, {width}x{height} pixels, {on}: {} ports compared with a plain run\n",
        report.graph, report.scene, report.ports_count
    );
    let mut table = table(&["check", "what", "result", "ports", "not compared"]);
    for Check { check, what, verdict } in &report.checks {
        let [result, compared, not_compared] = match verdict {
            Verdict::Same { compared_count, not_compared_count } => {
                ["same".into(), compared_count.to_string(), not_compared_count.to_string()]
            }
            Verdict::Differs { ports } => [format!("{} DIFFER", ports.len()), String::new(), String::new()],
            Verdict::NotApplicable { .. } => ["not applicable".into(), String::new(), String::new()],
        };
        table.add_row([check.to_string(), what.clone(), result, compared, not_compared]);
    }
    align_right(&mut table, &[3, 4]);
    text.push_str(&format!("{table}\n"));
    let mut said = Vec::new();
    for Check { check, what, verdict } in &report.checks {
        match verdict {
            Verdict::NotApplicable { .. } if said.contains(check) => {}
            Verdict::Same { .. } => {}
            Verdict::NotApplicable { why } => {
                text.push_str(&format!("{check}: not applicable: {why}\n"));
                said.push(check);
            }
            Verdict::Differs { ports } => {
                let here: Vec<&Difference> = ports.iter().filter(|port| port.begins_here).collect();
                for Difference { node, pass, port, comparison, .. } in &here {
                    let how = difference_text(comparison);
                    text.push_str(&format!("{check} ({what}): {node}.{port} ({pass}) differs: {how}\n"));
                }
                let after: Vec<String> = ports
                    .iter()
                    .filter(|port| !port.begins_here)
                    .map(|port| format!("{}.{}", port.node, port.port))
                    .collect();
                if !after.is_empty() {
                    text.push_str(&format!("{check} ({what}): what follows from it: {}\n", after.join(", ")));
                }
            }
        }
    }
    text
}

fn difference_text(comparison: &Comparison) -> String {
    match comparison {
        Comparison::Differs { count, of, first_row, what } => {
            format!("{count} of {of} {what}, first in row {first_row}")
        }
        // Only those are listed.
        other => unreachable!("{other:?} is no difference"),
    }
}
