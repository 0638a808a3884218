//! The cheapest variant that is right enough, or the most right one that is fast enough: chosen from what was measured on the scene
//! itself.

mod ron;

pub use ron::graph_text;

use serde::Serialize;
use shadowgraph_charts::metric::Metric;
use shadowgraph_charts::model::Point;

/// What a variant must satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// An error of at most so much; then the least time counts.
    Error(f64),
    /// A frame of at most so many milliseconds, to the upper end of its interval; then the least error counts, and of equal ones
    /// the least time.
    Millis(f64),
}

/// A variant that was chosen.
#[derive(Clone, Debug, Serialize)]
pub struct Suggestion<'a> {
    /// It.
    pub point: &'a Point,
    /// Its error.
    pub error: f64,
    /// Others that meet the bound and whose time cannot be told from its own: intervals overlap.
    pub as_fast: Vec<&'a Point>,
}

/// Chooses among the points of one scene and view; none where no point meets the bound.
pub fn suggest<'a>(points: &[&'a Point], metric: &Metric, bound: Bound) -> Option<Suggestion<'a>> {
    let measured = points.iter().filter(|point| point.failure.is_none());
    let mut meeting: Vec<(&Point, f64, f64)> = measured
        .filter_map(|point| Some((*point, point.millis?, metric.of(&point.errors)?)))
        .filter(|(_, millis, error)| match bound {
            Bound::Error(most) => *error <= most,
            Bound::Millis(most) => millis.high <= most,
        })
        .map(|(point, millis, error)| (point, millis.median, error))
        .collect();
    let by = |(_, millis, error): &(&Point, f64, f64)| match bound {
        Bound::Error(_) => (*millis, *error),
        Bound::Millis(_) => (*error, *millis),
    };
    meeting.sort_by(|a, b| by(a).0.total_cmp(&by(b).0).then(by(a).1.total_cmp(&by(b).1)));
    let (point, _, error) = *meeting.first()?;
    let high = point.millis?.high;
    let is_as_fast = |other: &&(&Point, f64, f64)| match bound {
        Bound::Error(_) => other.0.millis.is_some_and(|millis| millis.low <= high),
        Bound::Millis(_) => other.2 == error,
    };
    let as_fast = meeting[1..].iter().filter(is_as_fast).map(|(other, ..)| *other).collect();
    Some(Suggestion { point, error, as_fast })
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowgraph_charts::model::{Errors, Interval};

    fn point(label: &str, millis: [f64; 3], error: f64) -> Point {
        let [low, median, high] = millis;
        Point {
            label: label.into(),
            millis: Some(Interval { median, low, high }),
            errors: Errors { rmse_all: Some(error), ..Errors::default() },
            ..Point::default()
        }
    }

    fn chosen(points: &[Point], bound: Bound) -> Option<(String, Vec<String>)> {
        let points: Vec<&Point> = points.iter().collect();
        let found = suggest(&points, Metric::named("rmse_all")?, bound)?;
        Some((found.point.label.clone(), found.as_fast.iter().map(|point| point.label.clone()).collect()))
    }

    #[test]
    fn the_cheapest_that_is_right_enough_and_the_most_right_that_is_fast_enough() {
        let mut points = vec![
            point("cheap and wrong", [0.9, 1.0, 1.1], 0.3),
            point("fair", [3.0, 4.0, 5.0], 0.02),
            point("fair too", [4.5, 5.0, 6.0], 0.01),
            point("right", [50.0, 60.0, 70.0], 0.0),
        ];
        assert_eq!(chosen(&points, Bound::Error(0.05)), Some(("fair".into(), vec!["fair too".into()])));
        assert_eq!(chosen(&points, Bound::Error(0.0)), Some(("right".into(), vec![])));
        assert_eq!(chosen(&points, Bound::Millis(5.5)), Some(("fair".into(), vec![])));
        assert_eq!(chosen(&points, Bound::Millis(6.0)), Some(("fair too".into(), vec![])));
        assert_eq!(chosen(&points, Bound::Millis(1.0)), None);
        points[1].failure = Some("lost".into());
        assert_eq!(chosen(&points, Bound::Error(0.05)), Some(("fair too".into(), vec![])));
    }
}
