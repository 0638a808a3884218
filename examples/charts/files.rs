//! Charts of a whole suite as stand-alone SVG files, by file name.

use crate::group::{cases, places};
use crate::metric::{FRAME_FIGURES, Metric};
use crate::model::{Point, Stability};
use crate::page::{FindFront, columns, heading, summary_cell};
use crate::style::Styles;
use crate::svg::bars::{Bars, bars};
use crate::svg::heat::heat;
use crate::svg::scatter::{Scatter, scatter};
use crate::svg::sequence::{Lines, lines};

/// A file's name and text.
pub type File = (String, String);

/// For each scene and view: time against each of `metrics`, `SCENE-VIEW.METRIC.svg`, and the bars, `SCENE-VIEW.nodes.svg`.
pub fn charts(points: &[Point], metrics: &[&Metric], front: &FindFront) -> Vec<File> {
    let styles = Styles::of_points(points);
    let mut files = Vec::new();
    for (place, mut points) in places(points) {
        points.sort_by_key(|point| (styles.method(&point.graph), styles.is_hollow(&point.backend)));
        let title = place.title();
        let stem = unused(&title, &files);
        for metric in metrics {
            let front = front(&points, metric);
            let spec =
                Scatter { title: &title, points: &points, metric, front: &front, styles: &styles, with_legend: true };
            files.push((format!("{stem}.{}.svg", metric.name), scatter(&spec).svg));
        }
        let chart = bars(&Bars { title: &title, points: &points, styles: &styles });
        files.push((format!("{stem}.nodes.svg"), chart.svg));
    }
    files
}

/// The table of methods and cases, `stability.svg`, and for each case the figure that most of its records are judged by,
/// `SCENE-VIEW-SEQUENCE.FIGURE.svg`.
pub fn stability(records: &[Stability]) -> Vec<File> {
    let styles = Styles::of_stabilities(records);
    let cases = cases(records);
    let columns = columns(records, &styles);
    let rows: Vec<String> = cases.iter().map(|(case, _)| case.title()).collect();
    let headings: Vec<String> = columns.iter().map(|(_, column)| heading(*column, &styles)).collect();
    let cell = |row: usize, column: usize| summary_cell(&cases[row].1, columns[column]);
    let mut files = vec![("stability.svg".into(), heat("Methods and failure scenes", &rows, &headings, cell))];
    for (case, records) in &cases {
        let judges = |name: &str| records.iter().filter(|record| record.judged_by == name).count();
        let Some(figure) = FRAME_FIGURES.iter().rev().max_by_key(|figure| judges(figure.name)) else { continue };
        let title = case.title();
        let stem = unused(&title, &files);
        let spec = Lines { title: &title, records, figure, styles: &styles, with_legend: true };
        files.push((format!("{stem}.{}.svg", figure.name), lines(&spec).svg));
    }
    files
}

/// A name of plain letters that no file so far has.
fn unused(title: &str, files: &[File]) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || letter == '_' { letter } else { '-' };
    let words: String = title.to_lowercase().chars().map(plain).collect();
    let words: Vec<&str> = words.split('-').filter(|word| !word.is_empty()).collect();
    let stem = if words.is_empty() { "chart".into() } else { words.join("-") };
    let is_free = |stem: &String| !files.iter().any(|(name, _)| name.split('.').next() == Some(stem));
    let numbered = (2..).map(|number| format!("{stem}-{number}"));
    std::iter::once(stem.clone()).chain(numbered).find(is_free).unwrap_or(stem)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::front;
    use crate::synthetic;
    use std::collections::BTreeSet;

    #[test]
    fn every_file_has_a_plain_name_of_its_own_and_is_a_drawing() {
        let mut points = synthetic::points();
        points[0].scene = "\u{5f71}".into();
        points[1].scene = "???".into();
        points[1].view = String::new();
        let metrics: Vec<&Metric> = crate::metric::METRICS.iter().collect();
        let files = charts(&points, &metrics, &front).into_iter().chain(stability(&synthetic::stabilities()));
        let mut names = BTreeSet::new();
        for (name, svg) in files {
            assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c)), "{name}");
            roxmltree::Document::parse(&svg).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(names.insert(name));
        }
        assert_eq!(names.len(), 8 * 12 + 1 + 14);
        assert!(names.contains("chart.nodes.svg"), "{names:?}");
    }

    #[test]
    fn no_records_no_faults() {
        assert!(charts(&[], &[], &front).is_empty());
        assert_eq!(stability(&[]).len(), 1);
    }
}
