//! Leaks apart: light where the truth has shadow, shadow where the truth has light. A mean of both would let them cancel.

use super::{MaskDifference, finite, same_length};
use crate::problem::Problem;

/// What leaks, as shares of all that was compared.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Leaks {
    /// Truth blocked, test lit.
    pub light_share: f64,
    /// Truth lit, test blocked.
    pub shadow_share: f64,
}

impl Leaks {
    /// As shares of bits compared; `None` when no bit was.
    pub fn of_masks(difference: &MaskDifference) -> Option<Self> {
        let share = |count: u64| count as f64 / difference.bits_count as f64;
        (difference.bits_count > 0).then(|| Self {
            light_share: share(difference.false_lit_count),
            shadow_share: share(difference.false_shadow_count),
        })
    }

    /// For methods without masks: the sum of `max(0, test - truth)` of the visible fractions `[P]` over the rows compared, and of
    /// `max(0, truth - test)`; `None` when no row was compared.
    ///
    /// At most the shares by bits, since bits of both kinds cancel within a row.
    ///
    /// # Errors
    /// The lengths differ, or a fraction compared is not finite.
    pub fn of_fractions(
        test: &[f32],
        truth: &[f32],
        compared: impl Fn(usize) -> bool,
    ) -> Result<Option<Self>, Problem> {
        same_length("visible fractions", test.len(), truth.len())?;
        let (mut rows, mut light, mut shadow) = (0u64, 0.0, 0.0);
        for row in (0..truth.len()).filter(|row| compared(*row)) {
            let error = finite("test", test, row)? - finite("truth", truth, row)?;
            rows += 1;
            light += error.max(0.0);
            shadow += (-error).max(0.0);
        }
        let share = |sum: f64| sum / rows as f64;
        Ok((rows > 0).then(|| Self { light_share: share(light), shadow_share: share(shadow) }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::mask_difference;
    use super::*;

    fn of_bits(test: &[u32], truth: &[u32]) -> Option<Leaks> {
        Leaks::of_masks(&mask_difference(test, truth, 1, 4, |_| true))
    }

    #[test]
    fn bits_leak_by_kind_and_swapping_swaps_the_kinds() {
        let (test, truth) = ([0b0000, 0b1111], [0b0011, 0b1110]);
        assert_eq!(of_bits(&truth, &truth), Some(Leaks { light_share: 0.0, shadow_share: 0.0 }));
        assert_eq!(of_bits(&test, &truth), Some(Leaks { light_share: 0.25, shadow_share: 0.125 }));
        assert_eq!(of_bits(&truth, &test), Some(Leaks { light_share: 0.125, shadow_share: 0.25 }));
        assert_eq!(of_bits(&[], &[]), None);
    }

    #[test]
    fn fractions_leak_by_kind_and_do_not_cancel_across_rows() {
        let (test, truth) = ([0.5, 0.0, 1.0, 1.0], [0.0, 0.25, 1.0, 1.0]);
        let leaks = |test, truth| Leaks::of_fractions(test, truth, |_| true).unwrap();
        assert_eq!(leaks(&truth, &truth), Some(Leaks { light_share: 0.0, shadow_share: 0.0 }));
        assert_eq!(leaks(&test, &truth), Some(Leaks { light_share: 0.125, shadow_share: 0.0625 }));
        assert_eq!(leaks(&truth, &test), Some(Leaks { light_share: 0.0625, shadow_share: 0.125 }));
    }

    #[test]
    fn nothing_compared_is_no_figure_and_bad_input_is_refused() {
        assert_eq!(Leaks::of_fractions(&[1.0], &[0.0], |_| false).unwrap(), None);
        assert!(Leaks::of_fractions(&[f32::NAN], &[0.0], |_| true).is_err());
        assert!(Leaks::of_fractions(&[0.0], &[f32::NEG_INFINITY], |_| true).is_err());
        assert!(Leaks::of_fractions(&[0.0], &[0.0; 2], |_| true).is_err());
    }

    #[test]
    fn an_edge_shifted_by_one_pixel_leaks_one_row() {
        let edge = |at: usize| (0..10).map(|pixel| if pixel < at { 0.0 } else { 1.0 }).collect::<Vec<f32>>();
        let leaks = Leaks::of_fractions(&edge(4), &edge(5), |_| true).unwrap();
        assert_eq!(leaks, Some(Leaks { light_share: 0.1, shadow_share: 0.0 }));
    }
}
