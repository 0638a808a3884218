//! Records as tables for other programs: RFC 4180, one header, units in names, an empty field where nothing was measured.

mod points;
mod stability;

pub use points::{nodes, points};
pub use stability::{frames, stability};

use crate::model::Provenance;

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
