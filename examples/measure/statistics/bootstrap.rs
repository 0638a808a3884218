//! The bootstrap interval of a median, without drawing a single resample.
//!
//! **Percentile, not BCa.** BCa takes its acceleration from the jackknife, which fails for medians: leaving one value out moves the
//! median to one of at most three places, however many values there are (Efron, Tibshirani 1993, "An Introduction to the
//! Bootstrap", 11.6). The percentile interval of the median is consistent, and turning values into their logarithms or back does
//! not change which of them are its ends when their number is odd.
//!
//! **Exact, not drawn.** The median of a resample is one of the values, or the mean of two; their chances are known (Maritz, Jarrett
//! 1978, "A note on estimating the variance of the sample median", JASA 73; Hutson, Ernst 2000, "The exact bootstrap mean and
//! variance of an L-estimator", JRSS B 62). With n draws from values 1..n in order, the k-th of the resample is at most value i with
//! the chance that at least k of n draws are, each at a chance of i / n. So there is no seed, no noise in the tails, where a verdict
//! looks, and the same values give the same interval everywhere.

use super::binomial::{ln_choose, tail};
use super::{Interval, check_confidence, sorted};
use shadowgraph_core::problem::Problem;

/// Below e to the power of this a chance does not count.
const LEAST_LOG: f64 = -45.0;

/// Percentile bootstrap interval of the median at `confidence`, two-sided: the smallest and the largest value that the median of a
/// resample stays at or beyond with a chance of `(1 - confidence) / 2`.
///
/// It cannot reach past the values, so with few of them (below about 10) it is too narrow; one value gives itself.
///
/// # Errors
/// There is no value, one is not finite, or the confidence is not between 0 and 1.
pub fn bootstrap_interval(values: &[f64], confidence: f64) -> Result<Interval, Problem> {
    check_confidence(confidence)?;
    let values = sorted(values)?;
    let mut medians = medians(&values);
    medians.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let outside = (1.0 - confidence) / 2.0;
    let (low, high) = (first_with(outside, medians.iter()), first_with(outside, medians.iter().rev()));
    match (low, high) {
        (Some(low), Some(high)) => Ok(Interval { low, high }),
        _ => unreachable!("chances of {} medians do not add up to {outside}", medians.len()),
    }
}

/// The first value at which the chances add up to `outside`.
fn first_with<'a>(outside: f64, mut walk: impl Iterator<Item = &'a (f64, f64)>) -> Option<f64> {
    let mut sum = 0.0;
    let found = walk.find(|(_, chance)| {
        sum += chance;
        sum >= outside
    });
    found.map(|(value, _)| *value)
}

/// Every median that a resample of the sorted values can have, and its chance.
fn medians(values: &[f64]) -> Vec<(f64, f64)> {
    let count = values.len();
    let upper = |i: usize, k: usize| tail(count as u64, k as u64, i as f64 / count as f64);
    // Ranks of the middle have a standard deviation of half the root of the count; ten of it hold all that counts.
    let middle = count / 2;
    let reach = 5 * (count as f64).sqrt().ceil() as usize + 1;
    let ranks = middle.saturating_sub(reach).max(1)..=(middle + reach).min(count);
    let mut before = 0.0;
    let mut at = |i: usize, k: usize| {
        let upto = upper(i, k);
        upto - std::mem::replace(&mut before, upto)
    };
    if count % 2 == 1 {
        let k = middle + 1;
        return ranks.map(|i| (values[i - 1], at(i, k))).collect();
    }
    // Even: the k-th of the resample is value i and the next one is value j, for n = 2 k draws. With i < j, k draws are at most i, one
    // of them i itself, and k draws are at least j, one of them j itself.
    let k = middle;
    let share = |i: usize| i as f64 / count as f64;
    let ways = ln_choose(count as u64, k as u64);
    let ends_at = |i: usize| {
        let missed = if i == 1 { 0.0 } else { (k as f64 * ((i - 1) as f64 / i as f64).ln()).exp() };
        k as f64 * share(i).ln() + (-missed).ln_1p()
    };
    let mut medians = Vec::new();
    for i in ranks {
        let low = ways + ends_at(i);
        let above = low + k as f64 * (1.0 - share(i)).ln();
        let alone = at(i, k) - above.exp();
        medians.push((values[i - 1], alone.max(0.0)));
        for j in i + 1..=count {
            // By symmetry: k draws that start at j from above end there from below.
            let both = low + ends_at(count + 1 - j);
            if both < LEAST_LOG {
                break;
            }
            medians.push(((values[i - 1] + values[j - 1]) / 2.0, both.exp()));
        }
    }
    medians
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_add_up_to_one() {
        for count in [1, 2, 3, 4, 9, 10, 57, 100, 401, 1000, 4001] {
            let values: Vec<f64> = (0..count).map(f64::from).collect();
            let total: f64 = medians(&values).iter().map(|(_, chance)| chance).sum();
            assert!((total - 1.0).abs() < 1e-9, "{count}: {total}");
        }
    }

    #[test]
    fn chances_are_those_of_every_resample_of_few_values() {
        for count in [1usize, 2, 3, 4, 5, 6] {
            // Powers of two: every median has a value of its own.
            let values: Vec<f64> = (0..count).map(|index| (1 << index) as f64).collect();
            let mut counted = std::collections::BTreeMap::new();
            for resample in 0..count.pow(count as u32) {
                let mut drawn: Vec<f64> =
                    (0..count).map(|draw| values[resample / count.pow(draw as u32) % count]).collect();
                drawn.sort_unstable_by(f64::total_cmp);
                let middle = (drawn[(count - 1) / 2] + drawn[count / 2]) / 2.0;
                *counted.entry((middle * 2.0) as u64).or_insert(0u32) += 1;
            }
            let mut exact = std::collections::BTreeMap::new();
            for (value, chance) in medians(&values) {
                *exact.entry((value * 2.0) as u64).or_insert(0.0) += chance;
            }
            for (value, chance) in exact {
                let share = f64::from(*counted.get(&value).unwrap_or(&0)) / (count as f64).powi(count as i32);
                assert!((share - chance).abs() < 1e-12, "{count} values, median {value}/2: {chance}, counted {share}");
            }
        }
    }
}
