//! Which variants are worth their time: nothing else is both as fast and as right.

use crate::metric::Metric;
use crate::model::Point;

/// The Pareto front of points on one scene and view, for one error.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Front {
    /// Ids on the front, from the fastest on.
    pub on: Vec<String>,
    /// `(id, id of the point on the front that is as fast and as right, and better in one)`.
    pub dominated: Vec<(String, String)>,
}

impl Front {
    /// Whether `id` is on the front.
    pub fn has(&self, id: &str) -> bool {
        self.on.iter().any(|on| on == id)
    }

    /// Who dominates `id`.
    pub fn dominator(&self, id: &str) -> Option<&str> {
        self.dominated.iter().find(|(dominated, _)| dominated == id).map(|(_, by)| by.as_str())
    }
}

/// The front by median times. Points without a time, without this error, or with a failure take no part. Points equal in both
/// figures do not dominate each other.
pub fn front(points: &[&Point], metric: &Metric) -> Front {
    let figures = points.iter().filter(|point| point.failure.is_none());
    let figures =
        figures.filter_map(|point| Some((point.millis?.median, metric.of(&point.errors)?, point.id.as_str())));
    let mut figures: Vec<_> = figures.filter(|(millis, error, _)| millis.is_finite() && error.is_finite()).collect();
    figures.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut front = Front::default();
    let mut last: Option<(f64, f64, &str)> = None;
    for (millis, error, id) in figures {
        match last {
            Some((on_millis, on_error, by)) if on_error <= error && (on_millis, on_error) != (millis, error) => {
                front.dominated.push((id.into(), by.into()));
            }
            _ => {
                front.on.push(id.into());
                last = Some((millis, error, id));
            }
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Errors, Interval};

    fn point(id: &str, millis: f64, error: Option<f64>) -> Point {
        let millis = Some(Interval { median: millis, low: millis, high: millis });
        Point { id: id.into(), millis, errors: Errors { rmse_all: error, ..Errors::default() }, ..Point::default() }
    }

    #[test]
    fn by_hand() {
        let mut broken = point("broken", 0.1, Some(0.0));
        broken.failure = Some("no".into());
        let points = [
            point("fast", 1.0, Some(0.5)),
            point("slow_and_wrong", 2.0, Some(0.5)),
            point("right", 4.0, Some(0.0)),
            point("right_again", 4.0, Some(0.0)),
            point("right_later", 5.0, Some(0.0)),
            point("as_fast_but_worse", 1.0, Some(0.75)),
            point("none", 0.5, None),
            broken,
        ];
        let points: Vec<_> = points.iter().collect();
        let front = front(&points, Metric::named("rmse_all").unwrap());
        assert_eq!(front.on, ["fast", "right", "right_again"]);
        let dominated: Vec<_> = front.dominated.iter().map(|(id, by)| (id.as_str(), by.as_str())).collect();
        let expected = [("as_fast_but_worse", "fast"), ("slow_and_wrong", "fast"), ("right_later", "right_again")];
        assert_eq!(dominated, expected);
    }

    #[test]
    fn no_points_no_front() {
        assert_eq!(front(&[], &crate::metric::METRICS[0]), Front::default());
    }
}
