//! How wide penumbrae are, along the rows and columns of a picture: whether shadows harden at contacts as the light says.
//!
//! A **ramp** is a run of pixels along one row or column from a pixel at most [`LOW`] visible to one at least [`HIGH`] visible, or back,
//! with none of either kind between. Its **width** is the distance between the places where the fractions, joined by straight
//! lines from pixel to pixel, cross [`LOW`] and [`HIGH`]; its **middle** lies halfway between these. An edge that is hard in the
//! picture has a width of 0.8 pixels.
//!
//! Ramps are looked for in the truth. One counts if it is resolved (at least [`NARROWEST_PX`] wide) and monotone enough (no pixel lies
//! more than [`MOST_FALL`] below the brightest one before it, dark to light); the others are counted apart. The test's ramp at the
//! same place is the one of the same direction whose middle is nearest, between the true ramp before and the one after; it need not
//! be monotone. Where the test has none, the ramp is lost.
//!
//! A slanted penumbra is met along rows and along columns, with a width for each; ratios are the same.

use super::{finite, same_length};
use crate::problem::{Kind, Problem};

/// Visible fraction at the dark end of a ramp.
pub const LOW: f64 = 0.1;
/// Visible fraction at the light end of a ramp.
pub const HIGH: f64 = 0.9;
/// Largest fall within a ramp that still counts as monotone, visible fraction: a few of 128 light samples out of order.
pub const MOST_FALL: f64 = 0.05;
/// Narrowest ramp of the truth that counts, in pixels: below it a picture shows its own pixels rather than the penumbra.
pub const NARROWEST_PX: f64 = 2.0;

/// A ramp of the truth and the test's at the same place.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Ramp {
    /// Pixels of the truth's ramp, as rows of the picture's pixels: the last that is dark and the first that is light.
    pub pixels: [u32; 2],
    /// Width in the truth, pixels.
    pub truth_px: f64,
    /// Width in the test, pixels.
    pub test_px: f64,
    /// Distance between the middles, pixels, not negative.
    pub shift_px: f64,
}

/// Penumbra widths of a picture against the truth's.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PenumbraWidths {
    /// Ramps of the truth that count, found in the test or lost.
    pub ramps_count: u64,
    /// Those of them for which the test has no ramp.
    pub lost_count: u64,
    /// Ramps of the truth that are too narrow for the picture; not compared.
    pub unresolved_count: u64,
    /// Ramps of the truth that are wide enough but not monotone; not compared.
    pub uneven_count: u64,
    /// Median over ramps of width in the test over width in the truth: above 1 too soft, below too hard. `None` without ramps found.
    pub median_ratio: Option<f64>,
    /// Mean over ramps of how much the widths differ, pixels.
    pub mean_difference_px: Option<f64>,
    /// Mean over ramps of how far the test's middle lies from the truth's, pixels.
    pub mean_shift_px: Option<f64>,
    /// Every ramp found in the test.
    #[serde(skip)]
    pub ramps: Vec<Ramp>,
}

/// Measures ramps in pictures of visible fractions `[H W]` of `size` `[W, H]`.
///
/// `joined(a, b)` says of neighbouring pixels, as rows of the picture, whether both are compared and show one surface: a ramp
/// does not cross the edge of an object.
///
/// # Errors
/// A picture has another number of pixels, or a fraction anywhere is not finite.
pub fn penumbra_widths(
    test: &[f32],
    truth: &[f32],
    size: [usize; 2],
    joined: impl Fn(usize, usize) -> bool,
) -> Result<PenumbraWidths, Problem> {
    let [width, height] = size;
    same_length("visible fractions", test.len(), truth.len())?;
    if width.checked_mul(height) != Some(truth.len()) {
        return Err(Problem::new(Kind::BadValue, "visible fractions do not make up the picture")
            .expected(format!("{width} x {height}"))
            .found(truth.len().to_string()));
    }
    for row in 0..truth.len() {
        finite("test", test, row)?;
        finite("truth", truth, row)?;
    }
    let mut found = Found::default();
    let rows = (0..height).map(|y| (y * width, 1, width));
    let columns = (0..width).map(|x| (x, width, height));
    for (start, step, count) in rows.chain(columns) {
        let line: Vec<usize> = (0..count).map(|index| start + index * step).collect();
        for run in line.chunk_by(|a, b| joined(*a, *b)) {
            found.measure(run, test, truth);
        }
    }
    Ok(found.summary())
}

#[derive(Default)]
struct Found {
    ramps: Vec<Ramp>,
    lost: u64,
    unresolved: u64,
    uneven: u64,
}

impl Found {
    /// Takes in the pixels of one run.
    fn measure(&mut self, run: &[usize], test: &[f32], truth: &[f32]) {
        let along = |values: &[f32]| run.iter().map(|pixel| f64::from(values[*pixel])).collect::<Vec<_>>();
        let (test, truth) = (along(test), along(truth));
        let spans = spans(&truth);
        for (index, span) in spans.iter().enumerate() {
            let (width, middle) = span.extent(&truth);
            if width < NARROWEST_PX {
                self.unresolved += 1;
                continue;
            }
            if span.largest_fall(&truth) > MOST_FALL {
                self.uneven += 1;
                continue;
            }
            // From the near end of the ramp before to the near end of the one after.
            let from = if index == 0 { 0 } else { spans[index - 1].end };
            let to = spans.get(index + 1).map_or(truth.len() - 1, |next| next.start);
            let nearest = self::spans(&test[from..=to])
                .into_iter()
                .filter(|other| other.rises == span.rises)
                .map(|other| Span { start: other.start + from, end: other.end + from, ..other }.extent(&test))
                .map(|(test_px, place)| (test_px, (place - middle).abs()))
                .min_by(|a, b| a.1.total_cmp(&b.1));
            let Some((test_px, shift_px)) = nearest else {
                self.lost += 1;
                continue;
            };
            let ends = if span.rises { [span.start, span.end] } else { [span.end, span.start] };
            self.ramps.push(Ramp { pixels: ends.map(|at| run[at] as u32), truth_px: width, test_px, shift_px });
        }
    }

    fn summary(self) -> PenumbraWidths {
        let count = self.ramps.len();
        let mean = |of: fn(&Ramp) -> f64| (count > 0).then(|| self.ramps.iter().map(of).sum::<f64>() / count as f64);
        let mut ratios: Vec<f64> = self.ramps.iter().map(|ramp| ramp.test_px / ramp.truth_px).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        PenumbraWidths {
            ramps_count: count as u64 + self.lost,
            lost_count: self.lost,
            unresolved_count: self.unresolved,
            uneven_count: self.uneven,
            median_ratio: (count > 0).then(|| (ratios[(count - 1) / 2] + ratios[count / 2]) / 2.0),
            mean_difference_px: mean(|ramp| (ramp.test_px - ramp.truth_px).abs()),
            mean_shift_px: mean(|ramp| ramp.shift_px),
            ramps: self.ramps,
        }
    }
}

/// From a pixel of one end to the next pixel of the other.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    start: usize,
    end: usize,
    /// Dark to light.
    rises: bool,
}

impl Span {
    /// Where the fractions cross the level between two neighbouring pixels.
    fn crossing(values: &[f64], at: usize, level: f64) -> f64 {
        at as f64 + (level - values[at]) / (values[at + 1] - values[at])
    }

    /// Width and middle in pixels.
    fn extent(&self, values: &[f64]) -> (f64, f64) {
        let [first, last] = if self.rises { [LOW, HIGH] } else { [HIGH, LOW] };
        let from = Self::crossing(values, self.start, first);
        let to = Self::crossing(values, self.end - 1, last);
        (to - from, (from + to) / 2.0)
    }

    /// How far a pixel lies below the brightest before it, dark to light.
    fn largest_fall(&self, values: &[f64]) -> f64 {
        let within = &values[self.start..=self.end];
        let falls = |walk: &mut dyn Iterator<Item = &f64>| {
            let mut brightest = f64::NEG_INFINITY;
            walk.fold(0.0f64, |fall, value| {
                brightest = brightest.max(*value);
                fall.max(brightest - value)
            })
        };
        if self.rises { falls(&mut within.iter()) } else { falls(&mut within.iter().rev()) }
    }
}

/// Every ramp along a run, in order.
fn spans(values: &[f64]) -> Vec<Span> {
    let mut spans = Vec::new();
    let mut last: Option<(usize, bool)> = None;
    for (end, value) in values.iter().enumerate() {
        let lit = *value >= HIGH;
        if !lit && *value > LOW {
            continue;
        }
        if let Some((start, was_lit)) = last
            && was_lit != lit
        {
            spans.push(Span { start, end, rises: lit });
        }
        last = Some((end, lit));
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shadow with a penumbra of `width` pixels from dark to light on either side, along one row of 64.
    fn shadow(width: f64, left: f64, right: f64) -> Vec<f32> {
        let at = |pixel: f64| ((left - pixel) / width + 0.5).max((pixel - right) / width + 0.5).clamp(0.0, 1.0);
        (0..64).map(|pixel| at(f64::from(pixel)) as f32).collect()
    }

    fn along_row(test: &[f32], truth: &[f32]) -> PenumbraWidths {
        penumbra_widths(test, truth, [truth.len(), 1], |_, _| true).unwrap()
    }

    fn near(found: Option<f64>, expected: f64) {
        assert!(found.is_some_and(|found| (found - expected).abs() < 1e-5), "{found:?} is not {expected}");
    }

    #[test]
    fn identity_finds_both_sides_and_no_difference() {
        let truth = shadow(10.0, 20.25, 44.25);
        let widths = along_row(&truth, &truth);
        assert_eq!((widths.ramps_count, widths.lost_count, widths.unresolved_count, widths.uneven_count), (2, 0, 0, 0));
        assert_eq!(
            (widths.median_ratio, widths.mean_difference_px, widths.mean_shift_px),
            (Some(1.0), Some(0.0), Some(0.0))
        );
        // From 10 to 90 % of 10 pixels.
        assert!(widths.ramps.iter().all(|ramp| (ramp.truth_px - 8.0).abs() < 1e-5), "{widths:?}");
        assert_eq!(widths.ramps[0].pixels, [25, 16]);
        assert_eq!(widths.ramps[1].pixels, [40, 49]);
    }

    #[test]
    fn a_penumbra_half_as_wide_again_is_so_and_swapping_inverts_the_ratio() {
        let (test, truth) = (shadow(15.0, 20.25, 44.25), shadow(10.0, 20.25, 44.25));
        let widths = along_row(&test, &truth);
        near(widths.median_ratio, 1.5);
        near(widths.mean_difference_px, 4.0);
        near(widths.mean_shift_px, 0.0);
        near(along_row(&truth, &test).median_ratio, 1.0 / 1.5);
    }

    #[test]
    fn a_shift_by_one_pixel_is_a_shift_and_no_width() {
        let widths = along_row(&shadow(10.0, 21.25, 45.25), &shadow(10.0, 20.25, 44.25));
        near(widths.median_ratio, 1.0);
        near(widths.mean_shift_px, 1.0);
    }

    #[test]
    fn columns_are_measured_like_rows_and_a_slant_in_both() {
        let truth = shadow(10.0, 20.25, 44.25);
        let column = penumbra_widths(&truth, &truth, [1, 64], |_, _| true).unwrap();
        assert_eq!((column.ramps_count, column.median_ratio), (2, Some(1.0)));
        let slant: Vec<f32> = (0..64 * 64)
            .map(|pixel| (((pixel % 64 + pixel / 64) as f32 - 63.0) / 16.0 + 0.5).clamp(0.0, 1.0))
            .collect();
        let both = penumbra_widths(&slant, &slant, [64, 64], |_, _| true).unwrap();
        let lengths: Vec<usize> = both.ramps.iter().map(|ramp| (ramp.pixels[1] - ramp.pixels[0]) as usize).collect();
        let along_rows = lengths.iter().filter(|length| **length < 64).count();
        assert!(along_rows > 40 && along_rows * 2 == lengths.len(), "{along_rows} of {}", lengths.len());
    }

    #[test]
    fn a_hard_test_of_a_soft_shadow_is_the_width_of_a_step() {
        let truth = shadow(10.0, 20.25, 44.25);
        let hard: Vec<f32> = truth.iter().map(|fraction| fraction.round()).collect();
        near(along_row(&hard, &truth).median_ratio, 0.1);
        let unresolved = along_row(&truth, &hard);
        assert_eq!((unresolved.ramps_count, unresolved.unresolved_count, unresolved.median_ratio), (0, 2, None));
    }

    #[test]
    fn what_the_test_does_not_show_is_lost_and_what_is_uneven_is_told() {
        let truth = shadow(10.0, 20.25, 44.25);
        let lost = along_row(&[1.0; 64], &truth);
        assert_eq!((lost.ramps_count, lost.lost_count, lost.median_ratio, lost.mean_shift_px), (2, 2, None, None));
        let mut bumpy = truth.clone();
        bumpy[20] += 0.2;
        let uneven = along_row(&bumpy, &bumpy);
        assert_eq!((uneven.ramps_count, uneven.uneven_count), (1, 1));
        // A bumpy test is measured all the same.
        assert_eq!(along_row(&bumpy, &truth).ramps.len(), 2);
    }

    #[test]
    fn the_ramp_of_a_neighbour_is_not_taken() {
        // The test keeps the left shadow's right side only: what is left must not be matched with the second shadow's.
        let truth = shadow(6.0, 10.0, 20.0);
        let truth: Vec<f32> = truth.iter().enumerate().map(|(at, v)| v.min(shadow(6.0, 40.0, 50.0)[at])).collect();
        let mut test = truth.clone();
        test[..30].fill(1.0);
        let widths = along_row(&test, &truth);
        assert_eq!((widths.ramps_count, widths.lost_count, widths.median_ratio), (4, 2, Some(1.0)));
    }

    #[test]
    fn ramps_do_not_cross_edges_of_objects() {
        let truth = shadow(10.0, 20.25, 44.25);
        let cut = penumbra_widths(&truth, &truth, [64, 1], |a, b| (a, b) != (20, 21)).unwrap();
        assert_eq!(cut.ramps_count, 1);
        assert_eq!(penumbra_widths(&truth, &truth, [64, 1], |_, _| false).unwrap().median_ratio, None);
    }

    #[test]
    fn bad_input_is_refused() {
        let truth = shadow(10.0, 20.25, 44.25);
        let mut holed = truth.clone();
        holed[5] = f32::NAN;
        for (test, truth) in [(&holed, &truth), (&truth, &holed)] {
            assert!(penumbra_widths(test, truth, [64, 1], |_, _| true).unwrap_err().to_string().contains("row 5"));
        }
        assert!(penumbra_widths(&truth, &truth, [63, 1], |_, _| true).is_err());
        assert!(penumbra_widths(&truth, &truth, [usize::MAX, 2], |_, _| true).is_err());
        assert!(penumbra_widths(&truth[1..], &truth, [64, 1], |_, _| true).is_err());
        assert_eq!(penumbra_widths(&[], &[], [0, 0], |_, _| true).unwrap().ramps_count, 0);
    }
}
