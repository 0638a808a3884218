//! How far a result is from the truth. Every metric ships with controls in its tests: identity, a planted change of known
//! value, swapped inputs, and input that must be refused.
//!
//! | Metric | Of | Function |
//! |---|---|---|
//! | wrong bits | masks | [`mask_difference`] |
//! | RMSE, 99th percentile, maximum, mean | visible fractions | [`grey_errors`] |
//! | light leak, shadow leak | either | [`Leaks`] |
//! | frame differences against the truth's | visible fractions | [`TemporalError`] |
//! | bits that toggle where the truth is constant | masks | [`ToggledBits`] |
//! | 10-90 % width of penumbrae | pictures of visible fractions | [`penumbra_widths`] |
//!
//! Everything is summed in 64-bit numbers. What cannot be measured is `None` or a [`Problem`], never a zero; a number that is not
//! finite is refused, never left out.

mod grey;
mod leak;
mod mask;
mod ramp;
mod temporal;

pub use grey::{ErrorSpread, GreyErrors, Penumbra, grey_errors};
pub use leak::Leaks;
pub use mask::{MaskDifference, mask_difference};
pub use ramp::{HIGH, LOW, MOST_FALL, NARROWEST_PX, PenumbraWidths, Ramp, penumbra_widths};
pub use temporal::{Fractions, FrameMasks, StepError, TemporalError, ToggledBits, same_rows};

use crate::problem::{Kind, Problem};

/// Refuses values of different lengths.
fn same_length(what: &str, test: usize, truth: usize) -> Result<(), Problem> {
    if test == truth {
        return Ok(());
    }
    Err(Problem::new(Kind::BadValue, format!("{what} of test and truth cannot be compared"))
        .expected(format!("{truth}, as in the truth"))
        .found(test.to_string())
        .remedy("compare runs with the same view-samples"))
}

/// The value at `row` as a 64-bit number, refused when it is not finite or not there.
fn finite(whose: &str, values: &[f32], row: usize) -> Result<f64, Problem> {
    let wrong = |found: String| {
        Problem::new(Kind::BadValue, format!("a visible fraction of the {whose} cannot be measured"))
            .expected("a finite number")
            .found(found)
    };
    match values.get(row) {
        Some(value) if value.is_finite() => Ok(f64::from(*value)),
        Some(value) => Err(wrong(format!("{value} in row {row}"))),
        None => Err(wrong(format!("row {row} of {}", values.len()))),
    }
}
