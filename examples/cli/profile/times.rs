//! Many readings of one thing.

use serde::Serialize;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;
use shadowgraph_measure::statistics::quantiles;

/// Times in order, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// How many.
    pub count: usize,
    /// The middle one.
    pub median: f64,
    /// One in twenty is smaller.
    pub p5: f64,
    /// One in twenty is larger.
    pub p95: f64,
    /// One in a hundred is larger; of fewer than a hundred times it lies between the largest two.
    pub p99: f64,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

impl Times {
    /// Of these; none when there are none.
    ///
    /// # Errors
    /// A time is not finite.
    pub fn of(millis: &[f64]) -> Result<Option<Self>, Problem> {
        if millis.is_empty() {
            return Ok(None);
        }
        let [p5, median, p95, p99, min, max]: [f64; 6] =
            match quantiles(millis, &[0.05, 0.5, 0.95, 0.99, 0.0, 1.0])?.try_into() {
                Ok(six) => six,
                Err(other) => unreachable!("six quantiles are asked for, not {other:?}"),
            };
        Ok(Some(Self { count: millis.len(), median, p5, p95, p99, min, max }))
    }

    /// From one in twenty to one in twenty.
    pub fn spread(&self) -> f64 {
        self.p95 - self.p5
    }
}

/// What became of readings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Readings {
    /// Good ones.
    pub spans_count: usize,
    /// Begin and end are one.
    pub zero_count: usize,
    /// The end comes before the begin.
    pub negative_count: usize,
    /// The device wrote no stamps.
    pub dropped_count: usize,
    /// Nothing to time: a node without a pass, or timers off.
    pub untimed_count: usize,
}

impl Readings {
    /// Counts one more.
    pub fn add(&mut self, reading: Reading) {
        *match reading {
            Reading::Span { .. } => &mut self.spans_count,
            Reading::Zero => &mut self.zero_count,
            Reading::Negative => &mut self.negative_count,
            Reading::Dropped => &mut self.dropped_count,
            Reading::Untimed => &mut self.untimed_count,
        } += 1;
    }

    /// Counts those of `other` too.
    pub fn extend(&mut self, other: Self) {
        self.spans_count += other.spans_count;
        self.zero_count += other.zero_count;
        self.negative_count += other.negative_count;
        self.dropped_count += other.dropped_count;
        self.untimed_count += other.untimed_count;
    }
}

/// Readings of one node, frame by frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Series {
    /// Of the frames in which every reading of the node is good; none where there is no such frame.
    pub times: Option<Times>,
    /// All of its readings.
    pub readings: Readings,
}

impl Series {
    /// Of one node: its readings in each frame, which has several where view-samples run in ranges.
    ///
    /// # Errors
    /// A time is not finite.
    pub fn of(frames: impl Iterator<Item = Vec<Reading>>) -> Result<Self, Problem> {
        let (mut series, mut millis) = (Self::default(), Vec::new());
        for pieces in frames {
            pieces.iter().for_each(|reading| series.readings.add(*reading));
            let good: Option<Vec<f64>> = pieces.iter().map(|reading| reading.millis()).collect();
            millis.extend(good.filter(|good| !good.is_empty()).map(|good| good.iter().sum::<f64>()));
        }
        series.times = Times::of(&millis)?;
        Ok(series)
    }
}

/// Whether two series of one node disagree: their medians lie further apart than the larger of their spreads, from one in twenty to one
/// in twenty, and than [`RESOLUTION_MILLIS`].
pub fn disagree(one: &Series, other: &Series) -> bool {
    let (Some(one), Some(other)) = (one.times, other.times) else { return false };
    (one.median - other.median).abs() > one.spread().max(other.spread()).max(RESOLUTION_MILLIS)
}

/// Differences below that are not worth a flag: a few timestamp ticks, a clock read.
pub const RESOLUTION_MILLIS: f64 = 0.002;

#[cfg(test)]
mod tests {
    use super::*;

    fn series(millis: &[f64]) -> Series {
        Series::of(millis.iter().map(|millis| vec![Reading::of(1.0, 1.0 + millis)])).unwrap()
    }

    #[test]
    fn bad_readings_are_counted_and_give_no_time() {
        let frames = [
            vec![Reading::of(0.0, 2.0), Reading::of(5.0, 6.0)],
            vec![Reading::of(0.0, 2.0), Reading::of(5.0, 5.0)],
            vec![Reading::of(3.0, 2.0)],
            vec![Reading::Dropped],
            vec![],
        ];
        let series = Series::of(frames.into_iter()).unwrap();
        assert_eq!(series.times.map(|times| (times.count, times.median)), Some((1, 3.0)));
        let Readings { spans_count, zero_count, negative_count, dropped_count, untimed_count } = series.readings;
        assert_eq!([spans_count, zero_count, negative_count, dropped_count, untimed_count], [3, 1, 1, 1, 0]);
        assert_eq!(Series::of(std::iter::empty()).unwrap().times, None);
    }

    #[test]
    fn medians_further_apart_than_both_spreads_disagree() {
        let steady = series(&[1.0, 1.01, 1.02, 1.03]);
        assert!(disagree(&steady, &series(&[1.2, 1.21, 1.22, 1.23])));
        assert!(!disagree(&steady, &series(&[1.0, 1.2, 1.25, 2.0])), "the other's spread is larger");
        assert!(!disagree(&steady, &series(&[])), "nothing to compare with");
        assert!(!disagree(&series(&[0.001; 3]), &series(&[0.002; 3])), "below the clock's resolution");
    }
}
