//! Visibility masks bit by bit.

/// Bits that differ between two visibility masks.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct MaskDifference {
    /// Rows compared.
    pub rows_count: u64,
    /// Bits compared: rows times light samples.
    pub bits_count: u64,
    /// Bits set in the test and not in the truth: wrongly blocked.
    pub false_shadow_count: u64,
    /// Bits set in the truth and not in the test: wrongly lit.
    pub false_lit_count: u64,
    /// Rows with any wrong bit, ascending.
    #[serde(skip)]
    pub wrong_rows: Vec<u32>,
}

impl MaskDifference {
    /// Wrong bits of both kinds.
    pub fn wrong_count(&self) -> u64 {
        self.false_shadow_count + self.false_lit_count
    }
    /// Wrong bits over bits compared; 0 when nothing was compared.
    pub fn wrong_share(&self) -> f64 {
        if self.bits_count == 0 { 0.0 } else { self.wrong_count() as f64 / self.bits_count as f64 }
    }
}

/// Compares masks `[P, M]` row by row over the first `light_samples` bits, where `compared(row)` holds.
///
/// Panics when the lengths differ or a row is too short for the light samples: such masks cannot be compared.
pub fn mask_difference(
    test: &[u32],
    truth: &[u32],
    row_words: usize,
    light_samples: usize,
    compared: impl Fn(usize) -> bool,
) -> MaskDifference {
    assert_eq!(test.len(), truth.len(), "masks of different sizes");
    assert!(row_words * 32 >= light_samples, "{row_words} words do not hold {light_samples} bits");
    let mut difference = MaskDifference::default();
    let rows = test.chunks_exact(row_words.max(1)).zip(truth.chunks_exact(row_words.max(1)));
    for (row, (test, truth)) in rows.enumerate().filter(|(row, _)| compared(*row)) {
        difference.rows_count += 1;
        difference.bits_count += light_samples as u64;
        let mut wrong = 0;
        for ((test, live), truth) in row_bits(test, light_samples).zip(truth) {
            let shadow = (test & !truth & live).count_ones();
            let lit = (truth & !test & live).count_ones();
            difference.false_shadow_count += u64::from(shadow);
            difference.false_lit_count += u64::from(lit);
            wrong += shadow + lit;
        }
        if wrong > 0 {
            difference.wrong_rows.push(row as u32);
        }
    }
    difference
}

/// The words of a row, each with the bits of it that stand for one of the `light_samples`.
pub(super) fn row_bits(row: &[u32], light_samples: usize) -> impl Iterator<Item = (u32, u32)> {
    row.iter().enumerate().map(move |(index, word)| {
        let bits = light_samples.saturating_sub(index * 32).min(32);
        (*word, if bits == 32 { u32::MAX } else { (1 << bits) - 1 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRUTH: [u32; 4] = [0b01, 0b10, 0xffff_ffff, 0];

    #[test]
    fn identity_is_zero_wrong_bits() {
        let difference = mask_difference(&TRUTH, &TRUTH, 1, 2, |_| true);
        assert_eq!((difference.wrong_count(), difference.rows_count, difference.bits_count), (0, 4, 8));
        assert!(difference.wrong_rows.is_empty());
    }

    #[test]
    fn a_planted_bit_of_each_kind_is_counted_as_its_kind() {
        let test = [0b11, 0b00, 0xffff_ffff, 0];
        let difference = mask_difference(&test, &TRUTH, 1, 2, |_| true);
        assert_eq!((difference.false_shadow_count, difference.false_lit_count), (1, 1));
        assert_eq!(difference.wrong_rows, [0, 1]);
        let swapped = mask_difference(&TRUTH, &test, 1, 2, |_| true);
        assert_eq!((swapped.false_shadow_count, swapped.false_lit_count), (1, 1));
    }

    #[test]
    fn bits_past_the_light_samples_do_not_count_and_rows_can_be_left_out() {
        assert_eq!(mask_difference(&[0b100], &[0], 1, 2, |_| true).wrong_count(), 0);
        assert_eq!(mask_difference(&[0b100], &[0], 1, 3, |_| true).wrong_count(), 1);
        let difference = mask_difference(&[1, 1], &[0, 0], 1, 1, |row| row == 1);
        assert_eq!((difference.rows_count, difference.wrong_rows.as_slice()), (1, [1].as_slice()));
    }

    #[test]
    fn rows_of_several_words_are_rows() {
        let test = [0, 1 << 5, 0, 0];
        let difference = mask_difference(&test, &[0; 4], 2, 40, |_| true);
        assert_eq!((difference.false_shadow_count, difference.bits_count), (1, 80));
        assert_eq!(difference.wrong_rows, [0]);
    }

    #[test]
    #[should_panic(expected = "different sizes")]
    fn masks_of_different_sizes_are_refused() {
        mask_difference(&[0; 3], &[0; 4], 1, 1, |_| true);
    }
}
