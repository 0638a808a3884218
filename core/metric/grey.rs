//! Errors of visible fractions.

use super::{finite, same_length};
use crate::problem::{Kind, Problem};

/// Which rows are true penumbra: the truth sees a part of the light, neither none nor all of it.
#[derive(Clone, Copy, Debug)]
pub enum Penumbra<'a> {
    /// By the truth's visible fraction: more than `margin` above 0 and more than `margin` below 1. Zero is right where fractions are
    /// counts over a count; weighted light samples add up to 1 only within rounding and need about 1e-6.
    Fraction {
        /// Visible fraction, 0 and more.
        margin: f32,
    },
    /// By the truth's mask `[P, row_words]`: neither empty nor full over the first `light_samples` bits.
    Mask {
        /// Bits, set = blocked.
        words: &'a [u32],
        /// Words a row.
        row_words: usize,
        /// Bits a row that count.
        light_samples: usize,
    },
}

impl Penumbra<'_> {
    fn check(&self, rows: usize) -> Result<(), Problem> {
        let Self::Mask { words, row_words, light_samples } = self else { return Ok(()) };
        same_length("mask words", words.len(), rows * row_words)?;
        if row_words * 32 < *light_samples {
            return Err(Problem::new(Kind::BadValue, "rows of the truth's mask are too short")
                .expected(format!("{light_samples} bits"))
                .found(format!("{row_words} words")));
        }
        Ok(())
    }

    fn holds(&self, row: usize, truth: f64) -> bool {
        match self {
            Self::Fraction { margin } => truth > f64::from(*margin) && truth < 1.0 - f64::from(*margin),
            Self::Mask { words, row_words, light_samples } => {
                let blocked = super::mask::row_bits(&words[row * row_words..][..*row_words], *light_samples)
                    .map(|(word, live)| (word & live).count_ones() as usize)
                    .sum::<usize>();
                blocked > 0 && blocked < *light_samples
            }
        }
    }
}

/// Errors of a visible fraction over some rows. Error means test less truth: above zero is too light.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ErrorSpread {
    /// Rows, at least one.
    pub rows_count: u64,
    /// Root of the mean squared error.
    pub rmse: f64,
    /// Smallest of the absolute errors that at least 99 in 100 rows do not exceed (nearest rank).
    pub p99: f64,
    /// Largest absolute error.
    pub max: f64,
    /// Mean error with its sign: above zero where light leaks in, below where shadow does.
    pub mean_signed: f64,
    /// First row with the largest absolute error.
    pub worst_row: u32,
}

impl ErrorSpread {
    /// Of errors by row; `None` without rows.
    fn of(errors: &[(u32, f64)]) -> Option<Self> {
        let count = errors.len();
        let (first, rest) = errors.split_first()?;
        let larger = |best: &(u32, f64), next: &(u32, f64)| if next.1.abs() > best.1.abs() { *next } else { *best };
        let worst = rest.iter().fold(*first, |best, next| larger(&best, next));
        let mut sizes: Vec<f64> = errors.iter().map(|(_, error)| error.abs()).collect();
        // In integers: 0.99 times a count rounds up past the rank.
        let rank = (count * 99).div_ceil(100) - 1;
        let (_, p99, _) = sizes.select_nth_unstable_by(rank, f64::total_cmp);
        Some(Self {
            rows_count: count as u64,
            rmse: (errors.iter().map(|(_, error)| error * error).sum::<f64>() / count as f64).sqrt(),
            p99: *p99,
            max: worst.1.abs(),
            mean_signed: errors.iter().map(|(_, error)| error).sum::<f64>() / count as f64,
            worst_row: worst.0,
        })
    }
}

/// Errors over all rows compared and over those in true penumbra.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct GreyErrors {
    /// Over all rows compared; `None` when there was none.
    pub all: Option<ErrorSpread>,
    /// Over rows compared that are true penumbra; `None` when there was none, which is no error of 0.
    pub penumbra: Option<ErrorSpread>,
}

/// Compares visible fractions `[P]`, 0 umbra to 1 lit, row by row where `compared(row)` holds.
///
/// Fractions outside 0..=1 are compared as they are.
///
/// # Errors
/// The lengths differ, or a fraction compared is not finite.
pub fn grey_errors(
    test: &[f32],
    truth: &[f32],
    penumbra: Penumbra,
    compared: impl Fn(usize) -> bool,
) -> Result<GreyErrors, Problem> {
    same_length("visible fractions", test.len(), truth.len())?;
    penumbra.check(truth.len())?;
    let (mut all, mut partly) = (Vec::new(), Vec::new());
    for row in (0..truth.len()).filter(|row| compared(*row)) {
        let (test, truth) = (finite("test", test, row)?, finite("truth", truth, row)?);
        let error = (row as u32, test - truth);
        all.push(error);
        if penumbra.holds(row, truth) {
            partly.push(error);
        }
    }
    Ok(GreyErrors { all: ErrorSpread::of(&all), penumbra: ErrorSpread::of(&partly) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRUTH: [f32; 6] = [0.0, 1.0, 0.5, 0.25, 0.75, 1.0];
    const EXACT: Penumbra = Penumbra::Fraction { margin: 0.0 };

    fn errors(test: &[f32], truth: &[f32]) -> GreyErrors {
        grey_errors(test, truth, EXACT, |_| true).unwrap()
    }

    #[test]
    fn identity_is_zero_over_rows_that_were_counted() {
        let found = errors(&TRUTH, &TRUTH);
        let zero = |rows_count, worst_row| {
            Some(ErrorSpread { rows_count, rmse: 0.0, p99: 0.0, max: 0.0, mean_signed: 0.0, worst_row })
        };
        assert_eq!(found, GreyErrors { all: zero(6, 0), penumbra: zero(3, 2) });
    }

    #[test]
    fn a_planted_error_has_its_known_value_and_swapping_turns_its_sign() {
        let mut test = TRUTH;
        test[3] += 0.5;
        let found = errors(&test, &TRUTH);
        let (all, penumbra) = (found.all.unwrap(), found.penumbra.unwrap());
        assert_eq!((all.rmse, all.max, all.worst_row), ((0.25f64 / 6.0).sqrt(), 0.5, 3));
        assert_eq!((penumbra.rmse, penumbra.mean_signed), ((0.25f64 / 3.0).sqrt(), 0.5 / 3.0));
        let swapped = errors(&TRUTH, &test).all.unwrap();
        assert_eq!((swapped.rmse, swapped.mean_signed), (all.rmse, -all.mean_signed));
    }

    #[test]
    fn an_error_in_full_light_is_not_one_of_the_penumbra() {
        let mut test = TRUTH;
        test[1] = 0.0;
        let found = errors(&test, &TRUTH);
        assert_eq!((found.all.unwrap().max, found.penumbra.unwrap().max), (1.0, 0.0));
    }

    #[test]
    fn without_penumbra_or_rows_there_is_no_figure() {
        let found = errors(&[1.0, 0.5], &[1.0, 0.0]);
        assert!(found.all.is_some() && found.penumbra.is_none());
        let nothing = grey_errors(&[1.0], &[0.5], EXACT, |_| false).unwrap();
        assert_eq!(nothing, GreyErrors { all: None, penumbra: None });
    }

    #[test]
    fn the_99th_percentile_is_a_nearest_rank() {
        let truth = [0.0; 200];
        let test: Vec<f32> = (0..200).map(|row| row as f32).collect();
        assert_eq!(errors(&test, &truth).all.unwrap().p99, 197.0);
        assert_eq!(errors(&test[..100], &truth[..100]).all.unwrap().p99, 98.0);
        assert_eq!(errors(&test[..2], &truth[..2]).all.unwrap().p99, 1.0);
    }

    #[test]
    fn penumbra_by_mask_and_by_fraction_with_a_margin() {
        // Three of 33 light samples in two words: partly, wholly, not at all; bits past the 33rd are no light samples.
        let words = [1, 0, u32::MAX, 1, 0, 2];
        let by_mask = Penumbra::Mask { words: &words, row_words: 2, light_samples: 33 };
        let found = grey_errors(&[0.5, 0.0, 1.0], &[0.25, 0.0, 1.0], by_mask, |_| true).unwrap();
        let penumbra = found.penumbra.unwrap();
        assert_eq!((penumbra.rows_count, penumbra.max), (1, 0.25));
        let nearly_lit = [0.999_999_9];
        assert!(errors(&nearly_lit, &nearly_lit).penumbra.is_some());
        let with_margin = Penumbra::Fraction { margin: 1e-6 };
        assert!(grey_errors(&nearly_lit, &nearly_lit, with_margin, |_| true).unwrap().penumbra.is_none());
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused_where_they_are_compared() {
        for (test, truth) in [([0.5, f32::NAN], [0.5; 2]), ([0.5; 2], [0.5, f32::INFINITY])] {
            let problem = grey_errors(&test, &truth, EXACT, |_| true).unwrap_err();
            assert_eq!(problem.kind, Kind::BadValue);
            assert!(problem.to_string().contains("in row 1"), "{problem}");
            assert!(grey_errors(&test, &truth, EXACT, |row| row == 0).is_ok());
        }
    }

    #[test]
    fn sizes_that_do_not_fit_are_refused() {
        assert_eq!(
            grey_errors(&[0.5], &[0.5; 2], EXACT, |_| true).unwrap_err().to_string(),
            "visible fractions of test and truth cannot be compared; expected 2, as in the truth; found 1 (compare runs with the \
             same view-samples)"
        );
        let short = Penumbra::Mask { words: &[0], row_words: 1, light_samples: 33 };
        assert!(grey_errors(&[0.5], &[0.5], short, |_| true).is_err());
        let few = Penumbra::Mask { words: &[0], row_words: 2, light_samples: 33 };
        assert!(grey_errors(&[0.5], &[0.5], few, |_| true).is_err());
    }

    #[test]
    fn a_shift_by_one_pixel_is_seen() {
        let truth: Vec<f32> = (0..64).map(|pixel| (pixel as f32 / 63.0).clamp(0.0, 1.0)).collect();
        let shifted: Vec<f32> = (0..64usize).map(|pixel| truth[pixel.saturating_sub(1)]).collect();
        let penumbra = errors(&shifted, &truth).penumbra.unwrap();
        assert!((penumbra.rmse - 1.0 / 63.0).abs() < 1e-6 && penumbra.mean_signed < 0.0, "{penumbra:?}");
    }
}
