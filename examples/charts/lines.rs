//! JSON Lines: one record a line, appended as a run goes on.

use crate::check::Record;
use shadowgraph_core::problem::{Kind, Place, Problem, Problems};
use std::collections::HashMap;

/// What a file of records holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Lines<T> {
    /// One record for each id, the last written, in the order in which ids first appear.
    pub records: Vec<T>,
    /// What is worth telling and stops nothing: a last line that a killed run left half written.
    pub remarks: Vec<Problem>,
    /// Records that a later one of the same id replaced.
    pub replaced_count: usize,
    /// A run that goes on cuts the file to this many bytes, ..
    pub whole_bytes: usize,
    /// .. writes this (a line end, or nothing), and appends.
    pub lead: &'static str,
}

/// A record as a line, with its line end.
///
/// # Errors
/// What [`Record::check`] finds: a number that is not finite never reaches a file, where it would read as not measured.
pub fn to_line<T: Record>(record: &T) -> Result<String, Problem> {
    record.check()?;
    let text = serde_json::to_string(record).map_err(|error| Problem::new(Kind::BadValue, error.to_string()))?;
    Ok(text + "\n")
}

/// Reads `bytes` of a file called `file`. Empty lines are skipped.
///
/// # Errors
/// Every line that is not a record, with its place, but for a last line that ends too early: that is what a killed run leaves
/// behind, and becomes a remark.
pub fn read<T: Record>(bytes: &[u8], file: &str) -> Result<Lines<T>, Problems> {
    let mut lines =
        Lines { records: Vec::<T>::new(), remarks: Vec::new(), replaced_count: 0, whole_bytes: bytes.len(), lead: "" };
    let mut by_id = HashMap::new();
    let mut problems = Vec::new();
    let mut start = 0;
    for (index, line) in bytes.split_inclusive(|byte| *byte == b'\n').enumerate() {
        let is_whole = line.ends_with(b"\n");
        match record::<T>(line, file, index + 1) {
            Ok(Some(record)) => {
                lines.lead = if is_whole { "" } else { "\n" };
                let next = lines.records.len();
                let position = *by_id.entry(record.id().to_ascii_lowercase()).or_insert(next);
                if position < next {
                    lines.records[position] = record;
                    lines.replaced_count += 1;
                } else {
                    lines.records.push(record);
                }
            }
            Ok(None) => {}
            Err(Fault::CutShort(problem)) if !is_whole => {
                lines.whole_bytes = start;
                lines.remarks.push(problem.remedy("the last line was not written to its end; it does not count"));
            }
            Err(Fault::CutShort(problem) | Fault::Wrong(problem)) => problems.push(problem),
        }
        start += line.len();
    }
    if problems.is_empty() { Ok(lines) } else { Err(Problems(problems)) }
}

enum Fault {
    /// The text ends before the record does.
    CutShort(Problem),
    Wrong(Problem),
}

fn record<T: Record>(line: &[u8], file: &str, number: usize) -> Result<Option<T>, Fault> {
    let place = |column| Place { file: file.into(), line: number, column, path: String::new() };
    if line.trim_ascii().is_empty() {
        return Ok(None);
    }
    let record: T = serde_json::from_slice(line.trim_ascii_end()).map_err(|error| {
        let problem = parse_problem(&error).at(place(error.column()));
        if error.is_eof() { Fault::CutShort(problem) } else { Fault::Wrong(problem) }
    })?;
    record.check().map_err(|problem| Fault::Wrong(problem.at(place(1))))?;
    Ok(Some(record))
}

/// Splits the parser's sentence into what was found and what was expected.
fn parse_problem(error: &serde_json::Error) -> Problem {
    let text = error.to_string();
    let text = text.split(" at line ").next().unwrap_or_default();
    let kind = if error.is_data() { Kind::BadValue } else { Kind::Syntax };
    if let Some(field) = text.strip_prefix("missing field ") {
        return Problem::new(Kind::Missing, "a record lacks a field").expected(field).found("no such key");
    }
    match text.split_once(", expected ") {
        Some((found, expected)) => Problem::new(kind, "a line that is not a record")
            .expected(expected)
            .found(found.replace("invalid type: ", "")),
        None => Problem::new(kind, "a line that is not a record").expected("one JSON object a line").found(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Interval, Point};

    fn point(id: u64, median: f64) -> Point {
        Point {
            id: format!("{id:016x}"),
            scene: "<&\"' \u{1F300}\n".into(),
            graph: "soft".into(),
            label: "soft".into(),
            millis: Some(Interval { median, low: median, high: median }),
            ..Point::default()
        }
    }

    fn file(points: &[Point]) -> String {
        points.iter().map(|point| to_line(point).unwrap()).collect()
    }

    #[test]
    fn what_is_written_is_read() {
        let points = [point(1, 1.5), point(2, 0.1 + 0.2)];
        let lines = read::<Point>(file(&points).as_bytes(), "p.jsonl").unwrap();
        assert_eq!((lines.records.as_slice(), lines.lead), (points.as_slice(), ""));
        assert_eq!(lines.whole_bytes, file(&points).len());
    }

    #[test]
    fn the_last_record_of_an_id_counts_in_the_first_ones_place() {
        let lines = read::<Point>(file(&[point(1, 1.0), point(2, 2.0), point(1, 3.0)]).as_bytes(), "p.jsonl").unwrap();
        assert_eq!((lines.records, lines.replaced_count), (vec![point(1, 3.0), point(2, 2.0)], 1));
    }

    #[test]
    fn every_cut_of_the_last_line_loses_that_record_alone_and_says_so() {
        let text = file(&[point(1, 1.0), point(2, 2.0)]);
        let first = file(&[point(1, 1.0)]).len();
        for cut in first + 1..text.len() - 1 {
            let lines = read::<Point>(&text.as_bytes()[..cut], "p.jsonl").unwrap();
            assert_eq!((lines.records.len(), lines.whole_bytes, lines.lead), (1, first, ""), "cut at {cut}");
            assert!(lines.remarks[0].to_string().starts_with("p.jsonl:2:"), "{}", lines.remarks[0]);
        }
        let without_line_end = read::<Point>(&text.as_bytes()[..text.len() - 1], "p.jsonl").unwrap();
        assert_eq!((without_line_end.records.len(), without_line_end.lead), (2, "\n"));
    }

    #[test]
    fn a_run_that_goes_on_loses_nothing() {
        let whole = file(&[point(1, 1.0), point(2, 2.0)]);
        for cut in 0..=whole.len() {
            let bytes = &whole.as_bytes()[..cut];
            let lines = read::<Point>(bytes, "p.jsonl").unwrap();
            let mut again = [&bytes[..lines.whole_bytes], lines.lead.as_bytes()].concat();
            for id in 1..=2 {
                let missing = !lines.records.iter().any(|have| have.id == point(id, 0.0).id);
                if missing {
                    again.extend(file(&[point(id, id as f64)]).bytes());
                }
            }
            let read = read::<Point>(&again, "p.jsonl").unwrap();
            assert_eq!((read.records, read.replaced_count), (vec![point(1, 1.0), point(2, 2.0)], 0), "cut at {cut}");
        }
    }

    #[test]
    fn faults_before_the_last_line_are_told_all_at_once() {
        let text = format!("{{\"id\": 3}}\n{{\n\n[1]\n{{}}\n{}", file(&[point(1, 1.0)]));
        let problems = read::<Point>(text.as_bytes(), "p.jsonl").unwrap_err();
        let expected = "p.jsonl:1:8: a line that is not a record; expected a string; found integer `3`
p.jsonl:2:1: a line that is not a record; expected one JSON object a line; found EOF while parsing an object
p.jsonl:4:2: a line that is not a record; expected a string; found integer `1`
p.jsonl:5:2: a record lacks a field; expected `id`; found no such key";
        assert_eq!(problems.to_string(), expected);
    }

    #[test]
    fn numbers_that_are_not_finite_are_neither_written_nor_read() {
        for wrong in [f64::NAN, f64::INFINITY, -1.0] {
            let problem = to_line(&point(1, wrong)).unwrap_err();
            assert_eq!(problem.port.as_deref(), Some("millis.median"), "{problem}");
        }
        let text = file(&[point(1, 1.0)]).replace("\"median\":1.0", "\"median\":null");
        assert!(read::<Point>(text.as_bytes(), "p").unwrap_err().to_string().contains("expected f64"));
    }
}
