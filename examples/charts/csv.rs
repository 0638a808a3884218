//! Records as tables for other programs: RFC 4180, one header, units in names, an empty field where nothing was measured.

use crate::model::{Point, Provenance, Stability, Verdict};

/// A row for each point; axes of choices are columns `set.AXIS`.
pub fn points(points: &[Point]) -> String {
    let mut axes: Vec<&str> = Vec::new();
    for (axis, _) in points.iter().flat_map(|point| &point.choices) {
        if !axes.contains(&axis.as_str()) {
            axes.push(axis);
        }
    }
    let sets: Vec<String> = axes.iter().map(|axis| format!("set.{axis}")).collect();
    let mut table = Table::default();
    let mut header: Vec<&str> = POINT.to_vec();
    header.extend(sets.iter().map(String::as_str));
    header.extend(ERRORS);
    header.extend(["failure"]);
    header.extend(PROVENANCE);
    table.row(header);
    for point in points {
        let [width, height] = point.size.map(|side| side.to_string());
        let millis =
            |of: fn(&crate::model::Interval) -> f64| point.millis.as_ref().map(of).map_or(String::new(), number);
        let mut fields = vec![
            point.id.clone(),
            point.suite.clone(),
            point.scene.clone(),
            point.view.clone(),
            point.graph.clone(),
            point.label.clone(),
            point.backend.clone(),
            width,
            height,
            point.light_samples.to_string(),
            millis(|time| time.median),
            millis(|time| time.low),
            millis(|time| time.high),
            point.runs_count.to_string(),
        ];
        let set = |axis: &&str| point.choices.iter().find(|(name, _)| name == axis).map(|(_, value)| value.clone());
        fields.extend(axes.iter().map(|axis| set(axis).unwrap_or_default()));
        let errors = &point.errors;
        let shares = [
            errors.wrong_bit_share,
            errors.light_leak_share,
            errors.shadow_leak_share,
            errors.rmse_penumbra,
            errors.rmse_all,
            errors.p99,
            errors.max,
            errors.mean_signed,
            errors.flip_tonemapped,
            errors.flip_linear,
            errors.penumbra_width_ratio,
        ];
        fields.extend(shares.map(optional));
        let counts = [errors.penumbra_rows_count, errors.rows_count];
        fields.extend(counts.map(|count| count.map_or(String::new(), |count| count.to_string())));
        fields.push(point.failure.clone().unwrap_or_default());
        fields.extend(provenance(&point.provenance));
        table.row(fields.iter().map(String::as_str));
    }
    table.text
}

const POINT: [&str; 14] = [
    "id",
    "suite",
    "scene",
    "view",
    "graph",
    "label",
    "backend",
    "width_px",
    "height_px",
    "light_samples_count",
    "median_millis",
    "low_millis",
    "high_millis",
    "runs_count",
];

const ERRORS: [&str; 13] = [
    "wrong_bit_share",
    "light_leak_share",
    "shadow_leak_share",
    "rmse_penumbra",
    "rmse_all",
    "p99",
    "max",
    "mean_signed",
    "flip_tonemapped",
    "flip_linear",
    "penumbra_width_ratio",
    "penumbra_rows_count",
    "rows_count",
];

const PROVENANCE: [&str; 10] = [
    "graph_hash",
    "scene_hash",
    "program_version",
    "commit",
    "adapter",
    "driver",
    "adapter_type",
    "threads_count",
    "wgpu_version",
    "started",
];

fn provenance(p: &Provenance) -> [String; 10] {
    [
        p.graph_hash.clone(),
        p.scene_hash.clone(),
        p.program_version.clone(),
        p.commit.clone(),
        p.adapter.clone(),
        p.driver.clone(),
        p.adapter_type.clone(),
        p.threads.to_string(),
        p.wgpu_version.clone(),
        p.started.clone(),
    ]
}

/// A row for each node of each point.
pub fn nodes(points: &[Point]) -> String {
    let mut table = Table::default();
    table.row([
        "id", "scene", "view", "label", "backend", "order", "node", "stage", "pass", "millis", "bytes", "counts",
    ]);
    for point in points {
        for (order, node) in point.nodes.iter().enumerate() {
            let counts: Vec<String> = node.counts.iter().map(|(name, count)| format!("{name}={count}")).collect();
            let [order, bytes] = [order.to_string(), node.bytes.to_string()];
            let (millis, counts) = (number(node.millis), counts.join(" "));
            let [id, scene, view] = [&point.id, &point.scene, &point.view];
            let names = [id, scene, view, &point.label, &point.backend, &order, &node.node, &node.stage, &node.pass];
            table.row(names.into_iter().chain([&millis, &bytes, &counts]).map(String::as_str));
        }
    }
    table.text
}

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
        let worst = |of: &dyn Fn(&crate::model::Worst) -> usize| {
            record.worst.as_ref().map_or(String::new(), |worst| of(worst).to_string())
        };
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

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-4..1e15).contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
}

fn optional(value: Option<f64>) -> String {
    value.map_or(String::new(), number)
}

#[derive(Default)]
struct Table {
    text: String,
}

impl Table {
    fn row<'a>(&mut self, fields: impl IntoIterator<Item = &'a str>) {
        for (index, field) in fields.into_iter().enumerate() {
            if index > 0 {
                self.text.push(',');
            }
            if field.contains(['"', ',', '\r', '\n']) {
                self.text.push('"');
                self.text.push_str(&field.replace('"', "\"\""));
                self.text.push('"');
            } else {
                self.text.push_str(field);
            }
        }
        self.text.push_str("\r\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    /// RFC 4180 read by its grammar.
    fn read(text: &str) -> Vec<Vec<String>> {
        let mut rows = vec![vec![String::new()]];
        let mut quoted = false;
        let mut letters = text.chars().peekable();
        while let Some(letter) = letters.next() {
            let row = rows.last_mut().unwrap();
            match letter {
                '"' if quoted && letters.peek() == Some(&'"') => row.last_mut().unwrap().extend(letters.next()),
                '"' => quoted = !quoted,
                ',' if !quoted => row.push(String::new()),
                '\r' if !quoted => {
                    assert_eq!(letters.next(), Some('\n'));
                    rows.push(vec![String::new()]);
                }
                letter => row.last_mut().unwrap().push(letter),
            }
        }
        assert_eq!(rows.pop(), Some(vec![String::new()]), "the last line is ended");
        rows
    }

    #[test]
    fn what_is_written_reads_back() {
        let mut all = synthetic::points();
        all[0].label = "a,\"b\"\r\nc 'd' <e> \u{5f71}".into();
        all[0].failure = Some("\"".into());
        let rows = read(&points(&all));
        assert_eq!(rows.len(), all.len() + 1);
        let column = |name: &str| rows[0].iter().position(|have| have == name).unwrap();
        for (row, point) in rows[1..].iter().zip(&all) {
            assert_eq!(row.len(), rows[0].len());
            assert_eq!((&row[column("label")], &row[column("scene")]), (&point.label, &point.scene));
            assert_eq!(row[column("median_millis")].parse().ok(), point.millis.map(|time| time.median));
            assert_eq!(row[column("rmse_penumbra")].parse().ok(), point.errors.rmse_penumbra);
            assert_eq!(row[column("failure")], point.failure.clone().unwrap_or_default());
        }
        let size = column("set.light_depth.size");
        assert!(rows[1..].iter().any(|row| row[size] == "2048") && rows[1..].iter().any(|row| row[size].is_empty()));
    }

    #[test]
    fn every_table_is_a_rectangle_and_has_every_record() {
        let (points, records) = (synthetic::points(), synthetic::stabilities());
        let node_count = points.iter().map(|point| point.nodes.len()).sum::<usize>();
        let frame_count = records.iter().map(|record| record.frames.len()).sum::<usize>();
        let tables = [
            (super::points(&points), points.len()),
            (nodes(&points), node_count),
            (stability(&records), records.len()),
            (frames(&records), frame_count),
            (super::points(&[]), 0),
            (stability(&[]), 0),
        ];
        for (text, count) in tables {
            let rows = read(&text);
            assert_eq!(rows.len(), count + 1);
            assert!(rows.iter().all(|row| row.len() == rows[0].len()));
        }
    }

    #[test]
    fn numbers_keep_every_digit() {
        for value in [0.0, 0.1 + 0.2, 1e-300, 1.7e308, 123456.75, 2e-5] {
            assert_eq!(number(value).parse::<f64>().unwrap(), value);
        }
        assert_eq!(number(2e-5), "2e-5");
    }
}
