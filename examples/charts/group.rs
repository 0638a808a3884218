//! Records that belong in one picture.

use crate::check::Record;
use crate::model::{Point, Sequence, Stability};
use shadowgraph_core::problem::{Kind, Place as ProblemPlace, Problem, Problems};
use std::collections::HashSet;

/// What points must share to be compared: times and errors of other scenes, views or sizes say nothing about each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Scene.
    pub scene: String,
    /// View.
    pub view: String,
    /// Picture width and height, pixels.
    pub size: [usize; 2],
}

impl Place {
    /// Scene and view.
    pub fn title(&self) -> String {
        if self.view.is_empty() { self.scene.clone() } else { format!("{} · {}", self.scene, self.view) }
    }
}

/// Points by place, in order of first appearance.
pub fn places(points: &[Point]) -> Vec<(Place, Vec<&Point>)> {
    let place = |point: &Point| Place { scene: point.scene.clone(), view: point.view.clone(), size: point.size };
    grouped(points, place)
}

/// What stability records must share to be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Failure scene.
    pub scene: String,
    /// View.
    pub view: String,
    /// What changes.
    pub sequence: Sequence,
    /// Name of the parameter.
    pub parameter: String,
}

impl Case {
    /// Scene, view and what changes.
    pub fn title(&self) -> String {
        let view = if self.view.is_empty() { String::new() } else { format!(" · {}", self.view) };
        format!("{}{view} · {}", self.scene, self.sequence.title())
    }
}

/// Records by case, in order of first appearance.
pub fn cases(records: &[Stability]) -> Vec<(Case, Vec<&Stability>)> {
    let case = |record: &Stability| Case {
        scene: record.scene.clone(),
        view: record.view.clone(),
        sequence: record.sequence,
        parameter: record.parameter.clone(),
    };
    grouped(records, case)
}

fn grouped<T, K: PartialEq>(records: &[T], key: impl Fn(&T) -> K) -> Vec<(K, Vec<&T>)> {
    let mut groups: Vec<(K, Vec<&T>)> = Vec::new();
    for record in records {
        let key = key(record);
        match groups.iter_mut().find(|(have, _)| *have == key) {
            Some((_, group)) => group.push(record),
            None => groups.push((key, vec![record])),
        }
    }
    groups
}

/// Whether all records are sound and no id comes twice.
///
/// # Errors
/// Every fault, placed at the record's id.
pub fn check_all<T: Record>(records: &[T]) -> Result<(), Problems> {
    let mut seen = HashSet::new();
    let mut problems = Vec::new();
    for record in records {
        let place = ProblemPlace { file: "records".into(), line: 0, column: 0, path: record.id().into() };
        if let Err(problem) = record.check() {
            problems.push(problem.at(place.clone()));
        }
        if !seen.insert(record.id()) {
            let problem = Problem::new(Kind::Duplicate, "two records with one id").at(place);
            problems.push(problem.remedy("read them with `lines::read`, where the last one counts"));
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(Problems(problems)) }
}
