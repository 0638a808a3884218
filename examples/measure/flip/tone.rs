//! From linear radiance to what a screen shows: one curve and one exposure for both pictures.

use crate::statistics::quantile;
use shadowgraph_core::array::Array;
use shadowgraph_core::problem::Problem;

/// Share of white that [`Exposure::of`] gives to what is nearly the brightest; HDR-FLIP begins its exposures at the same one.
const NEARLY_WHITE: f64 = 0.85;
/// Share of the pixels with any light that are at most that bright: a speck of light does not darken the picture.
const MOST_PIXELS: f64 = 0.99;

/// The filmic curve that FLIP calls ACES: `(a v^2 + b v) / (c v^2 + d v + e)`, a fit by Narkowicz (2015), "ACES filmic tone mapping
/// curve", with radiance taken times 0.6.
const CURVE: [f64; 5] = [0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14];

fn curve(value: f64) -> f64 {
    let [a, b, c, d, e] = CURVE;
    // Divided by the square: huge values stay finite.
    if value <= 0.0 { 0.0 } else { ((a + b / value) / (c + d / value + e / (value * value))).min(1.0) }
}

/// The radiance that the curve takes to `shown`, 0 to 1.
fn curve_inverse(shown: f64) -> f64 {
    let [a, b, c, d, e] = CURVE;
    let (a, b, c) = (a - shown * c, b - shown * d, -shown * e);
    (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
}

/// IEC 61966-2-1 encoding.
fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// How bright a picture is shown: radiance is taken times 2 to the power of `stops`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Exposure {
    /// Stops; 0 leaves radiance as it is.
    pub stops: f64,
}

impl Exposure {
    /// The exposure that shows the 99th percentile of the luminance of `truth` `[H W 4]`, over pixels that are not black, as 85 % of
    /// white. Luminance is `0.2126 R + 0.7152 G + 0.0722 B`. A picture that is black all over is shown as it is.
    ///
    /// # Errors
    /// As [`super::tone_mapped`].
    pub fn of(truth: &Array) -> Result<Self, Problem> {
        let luminance = |pixel: &[f32]| {
            let [red, green, blue] = [pixel[0], pixel[1], pixel[2]].map(f64::from);
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        };
        let rgb = super::rgb("truth", truth)?;
        let lit: Vec<f64> = rgb.chunks_exact(3).map(luminance).filter(|luminance| *luminance > 0.0).collect();
        if lit.is_empty() {
            return Ok(Self { stops: 0.0 });
        }
        Ok(Self { stops: (curve_inverse(NEARLY_WHITE) / quantile(&lit, MOST_PIXELS)?).log2() })
    }

    /// `image` `[H W 4]` as it is shown: sRGB `[H W 3]`, 0 to 1.
    ///
    /// # Errors
    /// As [`super::tone_mapped`].
    pub fn show(&self, image: &Array) -> Result<Vec<f32>, Problem> {
        let scale = self.stops.exp2();
        let rgb = super::rgb("picture", image)?;
        Ok(rgb.iter().map(|value| srgb(curve(f64::from(*value) * scale)) as f32).collect())
    }

    /// As [`Exposure::show`], packed 8-bit: what to look at beside a FLIP error.
    ///
    /// # Errors
    /// As [`super::tone_mapped`].
    pub fn show_bytes(&self, image: &Array) -> Result<Vec<u8>, Problem> {
        Ok(self.show(image)?.into_iter().map(super::byte).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[f32]) -> Array {
        let texels = values.iter().flat_map(|value| [*value, *value, *value, 1.0]).collect();
        Array::f32([1, values.len(), 4], texels)
    }

    #[test]
    fn the_curve_rises_from_black_to_white_and_turns_back() {
        assert_eq!((curve(0.0), curve(f64::MAX)), (0.0, 1.0));
        assert!((curve(curve_inverse(0.85)) - 0.85).abs() < 1e-12);
        // By hand at 1: 0.9216 over 1.3688.
        assert!((curve(1.0) - 0.9216 / 1.3688).abs() < 1e-12, "{}", curve(1.0));
        let steps: Vec<f64> = (0..200).map(|step| curve(f64::from(step) * 0.05)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] <= pair[1]));
        assert_eq!((srgb(0.0), (srgb(1.0) * 1e12).round()), (0.0, 1e12));
    }

    #[test]
    fn nearly_the_brightest_is_shown_nearly_white_and_a_speck_or_the_dark_does_not_count() {
        let mut values = vec![3.0; 400];
        values[0] = 1e6;
        values[200..].fill(0.0);
        let picture = grey(&values);
        let exposure = Exposure::of(&picture).unwrap();
        let shown = exposure.show(&picture).unwrap();
        assert!((f64::from(shown[3]) - srgb(0.85)).abs() < 1e-6, "{}", shown[3]);
        assert_eq!((shown[0], shown[3 * 399]), (1.0, 0.0));
        let brighter = Exposure { stops: exposure.stops + 1.0 }.show(&picture).unwrap();
        assert!(brighter[3] > shown[3]);
        assert_eq!(exposure.show_bytes(&picture).unwrap()[..4], [255, 255, 255, 237]);
    }

    #[test]
    fn the_exposure_undoes_a_brighter_light_and_black_is_left_alone() {
        let stops = |factor: f32| Exposure::of(&grey(&[0.5 * factor, 0.25 * factor, factor])).unwrap().stops;
        assert!((stops(1.0) - stops(1024.0) - 10.0).abs() < 1e-6);
        assert!((stops(1.0) - stops(1e-30) + 30.0 * 10f64.log2()).abs() < 1e-3);
        assert_eq!(Exposure::of(&grey(&[0.0; 3])).unwrap(), Exposure { stops: 0.0 });
        assert_eq!(Exposure { stops: 0.0 }.show(&grey(&[f32::MAX])).unwrap(), [1.0; 3]);
    }
}
