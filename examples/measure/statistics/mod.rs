//! Medians, quantiles and how sure they are.
//!
//! Timings have long tails and jumps, so everything rests on ranks: medians instead of means, intervals without an assumed
//! distribution. Values are taken to be independent; successive frames of one run are not quite, so an interval of a single
//! median over frames is too narrow. Ratios of paired blocks in random order ([`crate::paired`]) do not suffer from that.

mod binomial;
mod bootstrap;

pub use binomial::{sign_test, tail};
pub use bootstrap::bootstrap_interval;

use shadowgraph_core::problem::{Kind, Problem};

/// From `low` to `high`, both included.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Whether `value` lies in it.
    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
    /// Half of its length.
    pub fn half_width(&self) -> f64 {
        (self.high - self.low) / 2.0
    }
    /// Both ends through a function that rises.
    pub fn map(&self, rises: impl Fn(f64) -> f64) -> Self {
        Self { low: rises(self.low), high: rises(self.high) }
    }
}

/// The values in order.
fn sorted(values: &[f64]) -> Result<Vec<f64>, Problem> {
    if values.is_empty() {
        return Err(
            Problem::new(Kind::Missing, "there is nothing to take a quantile of").expected("at least one value")
        );
    }
    if let Some((index, value)) = values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
        return Err(Problem::new(Kind::BadValue, "a measured value cannot be used")
            .expected("a finite number")
            .found(format!("{value} as value {index}")));
    }
    let mut values = values.to_vec();
    values.sort_unstable_by(f64::total_cmp);
    Ok(values)
}

/// Refuses a confidence outside 0 to 1.
fn check_confidence(confidence: f64) -> Result<(), Problem> {
    if confidence > 0.0 && confidence < 1.0 {
        return Ok(());
    }
    Err(Problem::new(Kind::BadValue, "a confidence is a share")
        .expected("more than 0 and less than 1")
        .found(confidence.to_string()))
}

/// Quantiles by type 7 of Hyndman and Fan (1996), "Sample quantiles in statistical packages", The American Statistician 50(4):
/// the share `p` lies at place `p (n - 1)`, counted from 0, of the values in order, and between places on a straight line. The
/// default of R and NumPy.
///
/// # Errors
/// There is no value, one is not finite, or a share lies outside 0..=1.
pub fn quantiles(values: &[f64], shares: &[f64]) -> Result<Vec<f64>, Problem> {
    let values = sorted(values)?;
    let at = |share: &f64| {
        if !(0.0..=1.0).contains(share) {
            return Err(Problem::new(Kind::BadValue, "a quantile is asked for by a share")
                .expected("0 to 1")
                .found(share.to_string()));
        }
        let place = share * (values.len() - 1) as f64;
        let below = values[place.floor() as usize];
        let above = values[place.ceil() as usize];
        // Equal neighbours give themselves, not a rounded mean.
        Ok(if below == above { below } else { below + (above - below) * place.fract() })
    };
    shares.iter().map(at).collect()
}

/// One quantile; see [`quantiles`].
///
/// # Errors
/// As [`quantiles`].
pub fn quantile(values: &[f64], share: f64) -> Result<f64, Problem> {
    Ok(quantiles(values, &[share])?[0])
}

/// The middle value, or the mean of the middle two.
///
/// # Errors
/// There is no value, or one is not finite.
pub fn median(values: &[f64]) -> Result<f64, Problem> {
    quantile(values, 0.5)
}

/// Interval of the median between two of the values: covers the true median with at least `confidence` whatever the
/// distribution, as the values that a two-sided [`sign_test`] would not reject. `None` when there are too few values for it (fewer
/// than 6 at 95 %).
///
/// # Errors
/// There is no value, one is not finite, or the confidence is not between 0 and 1.
pub fn order_interval(values: &[f64], confidence: f64) -> Result<Option<Interval>, Problem> {
    check_confidence(confidence)?;
    let values = sorted(values)?;
    let count = values.len();
    // The median lies below the k-th value with the chance that fewer than k of the values lie below the median.
    let outside = |k: usize| tail(count as u64, (count - k + 1) as u64, 0.5);
    let ranks: Vec<usize> = (1..=count / 2).collect();
    let k = ranks.partition_point(|k| 2.0 * outside(*k) <= 1.0 - confidence);
    Ok((k > 0).then(|| Interval { low: values[k - 1], high: values[count - k] }))
}

#[cfg(test)]
mod tests;
