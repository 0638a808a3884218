//! Errors between frames: what flickers, pops or swims although each frame by itself may look right.

use super::mask::row_bits;
use super::{finite, same_length};
use crate::problem::{Kind, Problem};

/// Pairs of equal rows `[row before, row after]` where `compared(row)` holds: frames in which a row is the same view-sample.
pub fn same_rows(rows: usize, compared: impl Fn(usize) -> bool) -> impl Iterator<Item = [usize; 2]> {
    (0..rows).filter(move |row| compared(*row)).map(|row| [row, row])
}

/// Visible fractions `[P]` of one frame.
#[derive(Clone, Copy, Debug)]
pub struct Fractions<'a> {
    /// Of the method.
    pub test: &'a [f32],
    /// Of the truth, for the same view-samples.
    pub truth: &'a [f32],
}

/// How far one step from frame to frame is from the truth's.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct StepError {
    /// Which step, 0 the first.
    pub step: u64,
    /// Rows compared, at least one.
    pub rows_count: u64,
    /// Root of the mean square of `(test after - test before) - (truth after - truth before)`.
    pub rmse: f64,
    /// First row of the later frame where that is largest.
    pub worst_row: u32,
}

/// Error of frame differences, taken in step by step:
/// `T-RMSE^2 = mean over rows and steps of [(v_t - v_(t-1))_test - (v_t - v_(t-1))_truth]^2`.
///
/// An error that stays as it is costs nothing here; one that comes and goes does.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct TemporalError {
    /// Largest change of the truth, visible fraction, for which a row counts as still.
    pub still: f64,
    /// A still row pops when the test changes by more than this, visible fraction. Half a light sample's share tells every bit;
    /// what cannot be seen is below about 0.01.
    pub pop: f64,
    /// Steps taken in.
    pub steps_count: u64,
    /// Rows compared, over all steps.
    pub rows_count: u64,
    /// Rows in which the truth stood still, over all steps.
    pub still_count: u64,
    /// Rows among them in which the test popped.
    pub popped_count: u64,
    /// The step of the largest error; `None` when no row was compared.
    pub worst: Option<StepError>,
    #[serde(skip)]
    squares: f64,
}

impl TemporalError {
    /// No step yet; thresholds as in the fields.
    pub fn new(still: f64, pop: f64) -> Self {
        Self { still, pop, steps_count: 0, rows_count: 0, still_count: 0, popped_count: 0, worst: None, squares: 0.0 }
    }

    /// Takes in the step from one frame to the next over rows that correspond, `[row before, row after]`: see [`same_rows`]. Returns
    /// its error by itself, `None` when there was no row.
    ///
    /// # Errors
    /// Test and truth of a frame differ in length, a row is not there, or a fraction is not finite. Nothing is taken in then.
    pub fn step(
        &mut self,
        before: Fractions,
        after: Fractions,
        rows: impl IntoIterator<Item = [usize; 2]>,
    ) -> Result<Option<StepError>, Problem> {
        same_length("visible fractions", before.test.len(), before.truth.len())?;
        same_length("visible fractions", after.test.len(), after.truth.len())?;
        let (mut count, mut still, mut popped, mut squares) = (0u64, 0u64, 0u64, 0.0);
        let (mut largest, mut worst_row) = (-1.0, 0);
        for [old, new] in rows {
            let test = finite("test", after.test, new)? - finite("test", before.test, old)?;
            let truth = finite("truth", after.truth, new)? - finite("truth", before.truth, old)?;
            let error = test - truth;
            count += 1;
            squares += error * error;
            if error.abs() > largest {
                (largest, worst_row) = (error.abs(), new as u32);
            }
            if truth.abs() <= self.still {
                still += 1;
                popped += u64::from(test.abs() > self.pop);
            }
        }
        let step = (count > 0).then(|| StepError {
            step: self.steps_count,
            rows_count: count,
            rmse: (squares / count as f64).sqrt(),
            worst_row,
        });
        self.steps_count += 1;
        self.rows_count += count;
        self.still_count += still;
        self.popped_count += popped;
        self.squares += squares;
        if step.is_some_and(|step| self.worst.is_none_or(|worst| step.rmse > worst.rmse)) {
            self.worst = step;
        }
        Ok(step)
    }

    /// T-RMSE over all rows and steps; `None` when no row was compared.
    pub fn rmse(&self) -> Option<f64> {
        (self.rows_count > 0).then(|| (self.squares / self.rows_count as f64).sqrt())
    }

    /// Share of still rows that popped; `None` when the truth never stood still.
    pub fn popped_share(&self) -> Option<f64> {
        (self.still_count > 0).then(|| self.popped_count as f64 / self.still_count as f64)
    }
}

/// Masks `[P, row_words]` of one frame, bit set = blocked.
#[derive(Clone, Copy, Debug)]
pub struct FrameMasks<'a> {
    /// Of the method.
    pub test: &'a [u32],
    /// Of the truth, for the same view-samples and light samples.
    pub truth: &'a [u32],
}

/// Bits that change between frames where the truth's bit does not, taken in step by step.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ToggledBits {
    /// Words a row.
    pub row_words: usize,
    /// Bits a row that count.
    pub light_samples: usize,
    /// Steps taken in.
    pub steps_count: u64,
    /// Bits that are constant in the truth, over all steps.
    pub constant_count: u64,
    /// Bits among them that change in the test.
    pub toggled_count: u64,
    /// Bits that change in the truth, over all steps.
    pub changed_count: u64,
    /// Bits among them that are constant in the test: frozen, which is the kind that swapped inputs would show.
    pub frozen_count: u64,
    /// The step with most toggled bits, 0 the first, and how many; `None` while none toggled.
    pub worst: Option<[u64; 2]>,
}

impl ToggledBits {
    /// No step yet.
    ///
    /// # Errors
    /// A row is too short for the light samples.
    pub fn new(row_words: usize, light_samples: usize) -> Result<Self, Problem> {
        if row_words * 32 < light_samples {
            return Err(Problem::new(Kind::BadValue, "rows of a mask are too short")
                .expected(format!("{light_samples} bits"))
                .found(format!("{row_words} words")));
        }
        Ok(Self {
            row_words,
            light_samples,
            steps_count: 0,
            constant_count: 0,
            toggled_count: 0,
            changed_count: 0,
            frozen_count: 0,
            worst: None,
        })
    }

    /// Takes in the step from one frame to the next over rows that correspond, `[row before, row after]`: see [`same_rows`]. Returns
    /// the rows of the later frame that have a toggled bit, in the order given.
    ///
    /// # Errors
    /// Test and truth of a frame differ in length, or a row is not there. Nothing is taken in then.
    pub fn step(
        &mut self,
        before: FrameMasks,
        after: FrameMasks,
        rows: impl IntoIterator<Item = [usize; 2]>,
    ) -> Result<Vec<u32>, Problem> {
        same_length("mask words", before.test.len(), before.truth.len())?;
        same_length("mask words", after.test.len(), after.truth.len())?;
        let mut sums = self.clone();
        let mut toggled_rows = Vec::new();
        for [old, new] in rows {
            let row = |words, row| mask_row(words, self.row_words, row);
            let test = row(before.test, old)?.iter().zip(row(after.test, new)?);
            let truth = row(before.truth, old)?.iter().zip(row(after.truth, new)?);
            let live = row_bits(row(after.truth, new)?, self.light_samples);
            let mut toggled = 0;
            for ((test, truth), (_, live)) in test.zip(truth).zip(live) {
                let (test, truth) = (test.0 ^ test.1, truth.0 ^ truth.1);
                toggled += (test & !truth & live).count_ones();
                sums.constant_count += u64::from((!truth & live).count_ones());
                sums.changed_count += u64::from((truth & live).count_ones());
                sums.frozen_count += u64::from((!test & truth & live).count_ones());
            }
            sums.toggled_count += u64::from(toggled);
            if toggled > 0 {
                toggled_rows.push(new as u32);
            }
        }
        let toggled = sums.toggled_count - self.toggled_count;
        if toggled > self.worst.map_or(0, |worst| worst[1]) {
            sums.worst = Some([self.steps_count, toggled]);
        }
        sums.steps_count += 1;
        *self = sums;
        Ok(toggled_rows)
    }

    /// Toggled bits over bits that are constant in the truth; `None` when there was none.
    pub fn toggled_share(&self) -> Option<f64> {
        (self.constant_count > 0).then(|| self.toggled_count as f64 / self.constant_count as f64)
    }
}

/// The words of one row.
fn mask_row(words: &[u32], row_words: usize, row: usize) -> Result<&[u32], Problem> {
    let found = row.checked_mul(row_words).and_then(|from| words.get(from..from.checked_add(row_words)?));
    found.ok_or_else(|| {
        Problem::new(Kind::BadValue, "a row of a mask is not there")
            .expected(format!("at most {}", (words.len() / row_words.max(1)).saturating_sub(1)))
            .found(format!("row {row}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAST: [f32; 4] = [0.0, 0.25, 0.5, 1.0];
    const NEXT: [f32; 4] = [0.0, 0.5, 0.5, 1.0];

    fn fractions<'a>(test: &'a [f32], truth: &'a [f32]) -> Fractions<'a> {
        Fractions { test, truth }
    }

    fn error_of(steps: &[[Fractions; 2]]) -> TemporalError {
        let mut error = TemporalError::new(0.0, 0.01);
        for [before, after] in steps {
            error.step(*before, *after, same_rows(4, |_| true)).unwrap();
        }
        error
    }

    #[test]
    fn identity_and_an_error_that_stays_are_zero() {
        let same = error_of(&[[fractions(&LAST, &LAST), fractions(&NEXT, &NEXT)]]);
        assert_eq!((same.rmse(), same.popped_share()), (Some(0.0), Some(0.0)));
        let [last, next] = [LAST, NEXT].map(|frame| frame.map(|fraction| fraction + 0.125));
        let offset = error_of(&[[fractions(&last, &LAST), fractions(&next, &NEXT)]]);
        assert_eq!((offset.rmse(), offset.popped_count, offset.still_count), (Some(0.0), 0, 3));
    }

    #[test]
    fn a_planted_pop_has_its_known_value() {
        let popped = [0.0, 0.5, 1.0, 1.0];
        let steps =
            [[fractions(&LAST, &LAST), fractions(&NEXT, &NEXT)], [fractions(&NEXT, &NEXT), fractions(&popped, &NEXT)]];
        let error = error_of(&steps);
        assert_eq!(error.rmse(), Some((0.25f64 / 8.0).sqrt()));
        assert_eq!((error.popped_count, error.still_count, error.rows_count, error.steps_count), (1, 7, 8, 2));
        let worst = StepError { step: 1, rows_count: 4, rmse: 0.25, worst_row: 2 };
        assert_eq!(error.worst, Some(worst));
    }

    #[test]
    fn swapped_inputs_have_the_same_rmse_and_no_pop() {
        // The test stands still where the truth moves: an error, but none that pops.
        let error = error_of(&[[fractions(&LAST, &LAST), fractions(&LAST, &NEXT)]]);
        assert_eq!((error.rmse(), error.popped_count), (Some(0.125), 0));
        let swapped = error_of(&[[fractions(&LAST, &LAST), fractions(&NEXT, &LAST)]]);
        assert_eq!((swapped.rmse(), swapped.popped_count), (Some(0.125), 1));
    }

    #[test]
    fn rows_that_correspond_are_compared_and_a_wrong_shift_by_one_is_seen() {
        let moved = [0.25, 0.5, 1.0, 1.0];
        let mut error = TemporalError::new(0.0, 0.01);
        let pairs = (1..4).map(|row| [row, row - 1]);
        error.step(fractions(&LAST, &LAST), fractions(&moved, &moved), pairs).unwrap();
        assert_eq!((error.rmse(), error.still_count), (Some(0.0), 3));
        // The truth moved by a pixel, the test did not.
        let late = error_of(&[[fractions(&LAST, &LAST), fractions(&LAST, &moved)]]);
        assert_eq!(late.rmse(), Some((0.0625f64 * 6.0 / 4.0).sqrt()));
    }

    #[test]
    fn bad_input_is_refused_and_leaves_the_sums_alone() {
        let mut error = error_of(&[[fractions(&LAST, &LAST), fractions(&NEXT, &NEXT)]]);
        let kept = error.clone();
        let holed = [0.0, f32::NAN, 0.5, 1.0];
        let all = || same_rows(4, |_| true);
        assert!(error.step(fractions(&LAST, &LAST), fractions(&holed, &NEXT), all()).is_err());
        assert!(error.step(fractions(&LAST, &holed), fractions(&NEXT, &NEXT), all()).is_err());
        assert!(error.step(fractions(&LAST, &LAST), fractions(&NEXT[..3], &NEXT), all()).is_err());
        let missing = error.step(fractions(&LAST, &LAST), fractions(&NEXT, &NEXT), [[0, 4]]).unwrap_err();
        assert!(missing.to_string().contains("row 4 of 4"), "{missing}");
        assert_eq!(error, kept);
        assert_eq!(error.step(fractions(&LAST, &LAST), fractions(&NEXT, &NEXT), []).unwrap(), None);
        assert_eq!(TemporalError::new(0.0, 0.0).rmse(), None);
        assert_eq!(TemporalError::new(0.0, 0.0).popped_share(), None);
    }

    fn masks<'a>(test: &'a [u32], truth: &'a [u32]) -> FrameMasks<'a> {
        FrameMasks { test, truth }
    }

    #[test]
    fn bits_toggle_where_the_truth_is_constant_and_freeze_where_it_changes() {
        let truth = [[0b0011, 0b0000], [0b0111, 0b0000]];
        let mut bits = ToggledBits::new(1, 4).unwrap();
        let rows = bits.step(masks(&truth[0], &truth[0]), masks(&truth[1], &truth[1]), same_rows(2, |_| true)).unwrap();
        assert!(rows.is_empty());
        assert_eq!((bits.toggled_count, bits.constant_count, bits.changed_count, bits.frozen_count), (0, 7, 1, 0));
        // One bit toggles in row 1; the fifth bit is no light sample.
        let test = [0b0111, 0b11000];
        let rows = bits.step(masks(&truth[0], &truth[0]), masks(&test, &truth[1]), same_rows(2, |_| true)).unwrap();
        assert_eq!(rows, [1]);
        assert_eq!((bits.toggled_count, bits.toggled_share(), bits.worst), (1, Some(1.0 / 14.0), Some([1, 1])));
        // Swapped: what toggled is frozen.
        let mut swapped = ToggledBits::new(1, 4).unwrap();
        swapped.step(masks(&truth[0], &truth[0]), masks(&truth[1], &test), same_rows(2, |_| true)).unwrap();
        assert_eq!((swapped.toggled_count, swapped.frozen_count), (0, 1));
    }

    #[test]
    fn masks_of_several_words_and_rows_that_moved() {
        let (old, new) = ([0, 1, 5, 6], [5, 6, 0, 1]);
        let mut bits = ToggledBits::new(2, 40).unwrap();
        let pairs = [[0, 1], [1, 0]];
        assert!(bits.step(masks(&old, &old), masks(&new, &new), pairs).unwrap().is_empty());
        assert_eq!((bits.toggled_count, bits.constant_count), (0, 80));
        // As if nothing had moved: every changed bit of the test toggles against a truth that stands.
        let rows = bits.step(masks(&old, &old), masks(&new, &old), same_rows(2, |_| true)).unwrap();
        assert_eq!((rows, bits.toggled_count), (vec![0, 1], 10));
    }

    #[test]
    fn masks_that_do_not_fit_are_refused() {
        assert!(ToggledBits::new(1, 33).is_err());
        let mut bits = ToggledBits::new(1, 32).unwrap();
        let kept = bits.clone();
        let one = masks(&[0], &[0]);
        assert!(bits.step(one, masks(&[0, 0], &[0]), [[0, 0]]).is_err());
        let missing = bits.step(one, one, [[0, 0], [0, 1]]).unwrap_err();
        assert_eq!(missing.to_string(), "a row of a mask is not there; expected at most 0; found row 1");
        assert_eq!(bits, kept);
        assert_eq!(bits.toggled_share(), None);
    }
}
