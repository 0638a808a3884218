//! From figures to places on paper, and the figures worth writing beside an axis.

/// One axis: a range of figures over a range of units on paper. On a logarithmic axis zero has a rail of its own, apart.
#[derive(Clone, Debug)]
pub struct Axis {
    is_log: bool,
    /// Ends of the range, logarithms where the axis is logarithmic.
    range: [f64; 2],
    /// Where the ends lie.
    paper: [f64; 2],
    /// Where zero lies, on a logarithmic axis.
    rail: f64,
    /// Whether the rail is written beside the axis.
    marks_zero: bool,
}

/// A line at a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The figure.
    pub value: f64,
    /// Text beside it; lines between those with a text have none.
    pub label: Option<String>,
}

/// Range on a logarithmic axis at least: room for two of 1, 2, 5, 10, ..
const LEAST_FACTOR: f64 = 6.0;
/// Free room at either end, as a share of the range.
const MARGIN: f64 = 0.05;

impl Axis {
    /// Logarithmic over those of `values` that are above zero; `rail` is where zero goes.
    pub fn log(values: impl IntoIterator<Item = f64>, paper: [f64; 2], rail: f64) -> Self {
        let logs = values.into_iter().filter(|value| value.is_finite() && *value > 0.0).map(f64::log10);
        let [low, high] = ends(logs).unwrap_or([-1.0, 1.0]);
        let lack = (LEAST_FACTOR.log10() - (high - low)).max(0.0) / 2.0;
        let margin = (high - low) * MARGIN;
        Self { is_log: true, range: [low - lack - margin, high + lack + margin], paper, rail, marks_zero: false }
    }

    /// Linear from zero, or from the least of `values` when `from_zero` is false.
    pub fn linear(values: impl IntoIterator<Item = f64>, from_zero: bool, paper: [f64; 2]) -> Self {
        let [low, high] = ends(values.into_iter().filter(|value| value.is_finite())).unwrap_or([0.0, 1.0]);
        let low = if from_zero { low.min(0.0) } else { low };
        let high = if high > low { high } else { low + low.abs().max(1.0) };
        Self { is_log: false, range: [low, high], paper, rail: paper[0], marks_zero: false }
    }

    /// Where a finite figure lies; panics on any other, which the caller has listed as not shown.
    pub fn at(&self, value: f64) -> f64 {
        assert!(value.is_finite(), "{value} has no place on an axis");
        if self.is_log && value <= 0.0 {
            return self.rail;
        }
        let value = if self.is_log { value.log10() } else { value };
        let share = (value - self.range[0]) / (self.range[1] - self.range[0]);
        self.paper[0] + share.clamp(0.0, 1.0) * (self.paper[1] - self.paper[0])
    }

    /// With a tick at zero, on its rail.
    pub fn with_zero_tick(mut self) -> Self {
        self.marks_zero = true;
        self
    }

    /// Lines within the range, ascending, at most `most` of them with a text; zero, where it is marked, comes on top.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        let zero = self.marks_zero.then(|| Tick { value: 0.0, label: Some("0".into()) });
        let others = if self.is_log { log_ticks(self.range, most) } else { linear_ticks(self.range, most) };
        zero.into_iter().chain(others).collect()
    }
}

fn ends(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |ends, value| {
        let [low, high] = ends.unwrap_or([value, value]);
        Some([low.min(value), high.max(value)])
    })
}

fn log_ticks([low, high]: [f64; 2], most: usize) -> Vec<Tick> {
    let decades = low.floor() as i32..=high.ceil() as i32;
    let all: Vec<(i32, u32)> = decades
        .flat_map(|decade| [1, 2, 5].map(|mantissa| (decade, mantissa)))
        .filter(|(decade, mantissa)| {
            let place = f64::from(*decade) + f64::from(*mantissa).log10();
            (low..=high).contains(&place)
        })
        .collect();
    let is_labelled = |stride: i32, (decade, mantissa): (i32, u32)| match stride {
        0 => true,
        stride => mantissa == 1 && decade.rem_euclid(stride) == 0,
    };
    let strides = [0, 1, 2, 3, 5, 10, 20, 50, 100, 200];
    let fits = |stride: &&i32| all.iter().filter(|tick| is_labelled(**stride, **tick)).count() <= most;
    let stride = *strides.iter().find(fits).unwrap_or(&500);
    let kept = all.into_iter().filter(|tick| stride <= 1 || is_labelled(stride, *tick));
    let tick = |(decade, mantissa): (i32, u32)| Tick {
        value: format!("{mantissa}e{decade}").parse().unwrap_or(0.0),
        label: is_labelled(stride, (decade, mantissa)).then(|| power_label(decade, mantissa)),
    };
    kept.map(tick).collect()
}

/// `0.002`, `5`, `20,000`; beyond that `2e-5`, `1e6`.
fn power_label(decade: i32, mantissa: u32) -> String {
    match decade {
        0..=4 => crate::number::count(u64::from(mantissa) * 10u64.pow(decade as u32)),
        -3..=-1 => format!("0.{}{mantissa}", "0".repeat((-decade - 1) as usize)),
        _ => format!("{mantissa}e{decade}"),
    }
}

fn linear_ticks([low, high]: [f64; 2], most: usize) -> Vec<Tick> {
    let rough = (high - low) / most.max(1) as f64;
    let decade = rough.log10().floor();
    let power = 10f64.powf(decade);
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|mantissa| mantissa * power >= rough).unwrap_or(10.0) * power;
    let first = (low / step).ceil();
    let count = ((high / step).floor() - first) as usize + 1;
    // A multiple of the step, written with the digits the step has: 0.30000000000000004 is nobody's tick.
    let digits = (-decade).max(0.0) as usize;
    let label = |value: f64| match value.abs() {
        size if size >= 1e5 || (digits > 4 && size > 0.0) => crate::number::figure(value),
        _ => format!("{value:.digits$}"),
    };
    (0..count)
        .map(|index| (first + index as f64) * step)
        .map(|value| Tick { value, label: Some(label(value + 0.0)) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, most: usize) -> Vec<String> {
        axis.ticks(most).into_iter().filter_map(|tick| tick.label).collect()
    }

    fn log(values: &[f64]) -> Axis {
        Axis::log(values.iter().copied(), [0.0, 100.0], -10.0)
    }

    #[test]
    fn logarithmic_ticks_are_1_2_5_then_decades_then_fewer() {
        assert_eq!(labels(&log(&[0.9, 110.0]), 8), ["1", "2", "5", "10", "20", "50", "100"]);
        assert_eq!(labels(&log(&[0.0009, 1100.0]), 8), ["0.001", "0.01", "0.1", "1", "10", "100", "1,000"]);
        assert_eq!(labels(&log(&[1e-9, 1.0]), 8), ["1e-8", "1e-6", "1e-4", "0.01", "1"]);
        assert_eq!(log(&[0.9, 110.0]).ticks(4).len(), 7, "lines without a text stay where decades are written");
    }

    #[test]
    fn any_range_has_two_ticks_and_not_too_many() {
        for exponent in -300..300 {
            for factor in [1.0, 1.1, 2.0, 4.9, 30.0, 1e4] {
                let low = 3.3 * 10f64.powi(exponent);
                let count = labels(&log(&[low, low * factor]), 8).len();
                assert!((2..=8).contains(&count), "{low} x {factor}: {count}");
                let axis = Axis::linear([low, low * factor], false, [0.0, 1.0]);
                let count = labels(&axis, 8).len();
                assert!((2..=9).contains(&count), "linear {low} x {factor}: {count}");
            }
        }
        assert_eq!(labels(&log(&[5e-324, f64::MAX]), 8).len(), 7);
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(labels(&Axis::linear([0.0, 1.0], true, [0.0, 1.0]), 5), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&Axis::linear([63.0], true, [0.0, 1.0]), 4), ["0", "20", "40", "60"]);
        assert_eq!(labels(&Axis::linear([-3.0, 3.0], true, [0.0, 1.0]), 4), ["-2", "0", "2"]);
    }

    #[test]
    fn zero_lies_on_the_rail_and_figures_within_the_paper() {
        let axis = log(&[0.0, 1e-5, 1e-1]);
        assert_eq!(axis.at(0.0), -10.0);
        let places = [1e-5, 1e-3, 1e-1].map(|value| axis.at(value));
        assert!(0.0 < places[0] && places[0] < places[1] && places[1] < places[2] && places[2] < 100.0);
        assert!((places[1] - 50.0).abs() < 1e-9, "{places:?}");
        assert_eq!(log(&[]).at(1.0), 50.0, "an axis of nothing is an axis");
    }

    #[test]
    #[should_panic(expected = "no place on an axis")]
    fn what_is_not_a_number_has_no_place() {
        log(&[1.0]).at(f64::NAN);
    }
}
