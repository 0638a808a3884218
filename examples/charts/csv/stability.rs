//! Stability and its frames.

use super::{PROVENANCE, Table, number, optional, provenance};
use crate::model::{Stability, Verdict, Worst};

/// A row for each record of stability.
pub fn stability(records: &[Stability]) -> String {
    let mut table = Table::default();
    let own = [
        "id",
        "suite",
        "scene",
        "view",
        "sequence",
        "parameter",
        "unit",
        "graph",
        "label",
        "backend",
        "verdict",
        "why",
        "judged_by",
        "figure",
        "threshold",
        "expected",
        "expected_source",
        "surprise",
        "frames_count",
        "worst_frame",
        "worst_x_px",
        "worst_y_px",
        "t_rmse",
        "toggled_share",
        "toggled_count",
    ];
    table.row(own.into_iter().chain(PROVENANCE));
    for record in records {
        let (verdict, why) = match &record.verdict {
            Verdict::Holds => ("holds", ""),
            Verdict::Fails => ("fails", ""),
            Verdict::NotRun { why } => ("not_run", why.as_str()),
        };
        let worst =
            |of: &dyn Fn(&Worst) -> usize| record.worst.as_ref().map_or(String::new(), |worst| of(worst).to_string());
        let temporal = record.temporal.unwrap_or_default();
        let mut fields: Vec<String> = vec![
            record.id.clone(),
            record.suite.clone(),
            record.scene.clone(),
            record.view.clone(),
            record.sequence.title().into(),
            record.parameter.clone(),
            record.unit.clone(),
            record.graph.clone(),
            record.label.clone(),
            record.backend.clone(),
            verdict.into(),
            why.into(),
            record.judged_by.clone(),
            optional(record.figure),
            optional(record.threshold),
            record.expected.title().into(),
            record.expected_source.clone(),
            record.verdict.surprises(record.expected).to_string(),
            record.frames.len().to_string(),
            worst(&|worst| worst.frame),
            worst(&|worst| worst.pixel[0]),
            worst(&|worst| worst.pixel[1]),
            optional(temporal.t_rmse),
            optional(temporal.toggled_share),
            temporal.toggled_count.map_or(String::new(), |count| count.to_string()),
        ];
        fields.extend(provenance(&record.provenance));
        table.row(fields.iter().map(String::as_str));
    }
    table.text
}

/// A row for each frame of each record of stability.
pub fn frames(records: &[Stability]) -> String {
    let mut table = Table::default();
    table.row([
        "id",
        "scene",
        "sequence",
        "label",
        "backend",
        "frame",
        "value",
        "unit",
        "wrong_bit_share",
        "light_leak_share",
        "shadow_leak_share",
        "rmse_penumbra",
        "millis",
        "longest_list_count",
    ]);
    for record in records {
        for (index, frame) in record.frames.iter().enumerate() {
            let [order, value] = [index.to_string(), number(frame.value)];
            let figures = [
                frame.wrong_bit_share,
                frame.light_leak_share,
                frame.shadow_leak_share,
                frame.rmse_penumbra,
                frame.millis,
            ];
            let figures = figures.map(optional);
            let longest = frame.longest_list_count.map_or(String::new(), |count| count.to_string());
            let names = [&record.id, &record.scene].map(String::as_str).into_iter();
            let names =
                names.chain([record.sequence.title(), &record.label, &record.backend, &order, &value, &record.unit]);
            table.row(names.chain(figures.iter().map(String::as_str)).chain([longest.as_str()]));
        }
    }
    table.text
}
