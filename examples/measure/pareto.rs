//! Which variants are worth their time: the front of milliseconds against error.
//!
//! A point is **dominated** when another is at least as good in both and better in one, by their values. It is dominated **beyond
//! doubt** when the other's intervals lie wholly on the better side: its upper ends are at most this one's lower ends in both, and
//! below in one. Points that are equal do not dominate each other.

use crate::statistics::Interval;
use shadowgraph_core::problem::{Kind, Problem};

/// A measured number and how sure it is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Measured {
    /// The number itself.
    pub value: f64,
    /// Holds it; of no length where it is exact.
    pub interval: Interval,
}

impl Measured {
    /// A number without doubt, such as wrong bits on given view-samples.
    pub fn exact(value: f64) -> Self {
        Self { value, interval: Interval { low: value, high: value } }
    }
}

/// What a variant costs and what it gets wrong. Less is better in both.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Point {
    /// Time of a frame, milliseconds.
    pub millis: Measured,
    /// Error by any metric that is 0 for the truth.
    pub error: Measured,
}

/// How a point stands among the others.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Standing {
    /// Points that dominate it, as places in the list given, fastest first; empty on the front.
    pub dominated_by: Vec<usize>,
    /// Those of them that do so beyond doubt.
    pub beyond_doubt_by: Vec<usize>,
}

impl Standing {
    /// Nothing is better: no less time for the same error, no less error for the same time.
    pub fn on_front(&self) -> bool {
        self.dominated_by.is_empty()
    }
}

/// Compares every point with every other; one answer a point, in their order.
///
/// # Errors
/// A number is not finite, or lies outside its interval.
pub fn standings(points: &[Point]) -> Result<Vec<Standing>, Problem> {
    for (index, point) in points.iter().enumerate() {
        for (name, Measured { value, interval }) in [("time", point.millis), ("error", point.error)] {
            let finite = [value, interval.low, interval.high].iter().all(|number| number.is_finite());
            if !finite || !interval.contains(value) {
                return Err(Problem::new(Kind::BadValue, format!("the {name} of point {index} cannot be compared"))
                    .expected("finite numbers, low <= value <= high")
                    .found(format!("{} <= {value} <= {}", interval.low, interval.high)));
            }
        }
    }
    let mut by_time: Vec<usize> = (0..points.len()).collect();
    by_time.sort_by(|a, b| {
        let [a, b] = [a, b].map(|index| points[*index]);
        a.millis.value.total_cmp(&b.millis.value).then(a.error.value.total_cmp(&b.error.value))
    });
    let better = |other: [f64; 2], own: [f64; 2]| other[0] <= own[0] && other[1] <= own[1] && other != own;
    let values = |point: &Point| [point.millis.value, point.error.value];
    let standing = |point: &Point| {
        let dominates = |other: &usize| better(values(&points[*other]), values(point));
        let beyond_doubt = |other: &usize| {
            let other = &points[*other];
            let highs = [other.millis.interval.high, other.error.interval.high];
            better(highs, [point.millis.interval.low, point.error.interval.low])
        };
        let dominated_by: Vec<usize> = by_time.iter().copied().filter(dominates).collect();
        let beyond_doubt_by = dominated_by.iter().copied().filter(beyond_doubt).collect();
        Standing { dominated_by, beyond_doubt_by }
    };
    Ok(points.iter().map(standing).collect())
}

/// Points of the front as places in the list given, fastest first; of equal points all.
///
/// # Errors
/// As [`standings`].
pub fn front(points: &[Point]) -> Result<Vec<usize>, Problem> {
    let standings = standings(points)?;
    let mut front: Vec<usize> = (0..points.len()).filter(|index| standings[*index].on_front()).collect();
    front.sort_by(|a, b| points[*a].millis.value.total_cmp(&points[*b].millis.value));
    Ok(front)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(millis: f64, error: f64) -> Point {
        Point { millis: Measured::exact(millis), error: Measured::exact(error) }
    }

    fn about(millis: f64, error: f64, share: f64) -> Point {
        let measured = |value: f64| Measured {
            value,
            interval: Interval { low: value * (1.0 - share), high: value * (1.0 + share) },
        };
        Point { millis: measured(millis), error: measured(error) }
    }

    #[test]
    fn the_front_is_what_nothing_beats_and_who_beats_the_rest_is_named() {
        let points = [point(4.0, 0.0), point(1.0, 0.5), point(2.0, 0.25), point(3.0, 0.3), point(5.0, 0.0)];
        assert_eq!(front(&points).unwrap(), [1, 2, 0]);
        let standings = standings(&points).unwrap();
        assert_eq!(standings[3].dominated_by, [2]);
        assert_eq!(standings[4].dominated_by, [0]);
        // Exact points are dominated beyond doubt, even where one of two numbers is equal.
        assert_eq!(standings[4].beyond_doubt_by, [0]);
        let planted = [point(1.0, 0.1), points[1], points[2]];
        assert_eq!(super::standings(&planted).unwrap()[1].dominated_by, [0]);
        assert_eq!(super::standings(&planted).unwrap()[2].dominated_by, [0]);
    }

    #[test]
    fn dominated_by_several_names_the_fastest_first() {
        let points = [point(3.0, 0.1), point(1.0, 0.3), point(2.0, 0.2), point(4.0, 0.4)];
        assert_eq!(standings(&points).unwrap()[3].dominated_by, [1, 2, 0]);
    }

    #[test]
    fn equal_points_do_not_dominate_each_other_and_one_alone_is_the_front() {
        let points = [point(1.0, 1.0), point(1.0, 1.0)];
        assert_eq!(front(&points).unwrap(), [0, 1]);
        assert_eq!(front(&points[..1]).unwrap(), [0]);
        assert!(front(&[]).unwrap().is_empty());
    }

    #[test]
    fn overlapping_intervals_leave_doubt() {
        let points = [about(1.0, 0.1, 0.1), about(1.1, 0.11, 0.1), about(1.5, 0.2, 0.1)];
        let standings = standings(&points).unwrap();
        assert_eq!((&standings[1].dominated_by[..], &standings[1].beyond_doubt_by[..]), (&[0][..], &[][..]));
        assert_eq!(standings[2].beyond_doubt_by, [0, 1]);
        // Swapped in time, neither is on top.
        let crossed = [about(1.1, 0.1, 0.01), about(1.0, 0.11, 0.01)];
        assert_eq!(front(&crossed).unwrap(), [1, 0]);
    }

    #[test]
    fn numbers_that_cannot_be_compared_are_refused() {
        let mut outside = point(1.0, 1.0);
        outside.error.interval.low = 2.0;
        outside.error.interval.high = 3.0;
        for bad in [point(f64::NAN, 0.0), point(1.0, f64::INFINITY), outside] {
            let problem = standings(&[point(1.0, 1.0), bad]).unwrap_err();
            assert!(problem.to_string().contains("of point 1"), "{problem}");
        }
    }
}
