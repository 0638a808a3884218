//! The one scale of error maps: colour of a difference of visible fractions, so that maps can be compared across methods,
//! scenes and pages.

/// Differences below this share the colour of zero.
const LEAST: f32 = 1.0 / 1024.0;
/// Pixels without a view-sample that was compared.
pub const NOT_COMPARED: [u8; 3] = [58, 58, 64];
/// A difference that is not a number: loud, and on no part of the scale.
pub const NOT_A_NUMBER: [u8; 3] = [255, 0, 255];

/// From too dark by 1 over right to too light by 1. Blue and orange differ for every kind of colour vision.
const DARK: [[f32; 3]; 4] = [[244.0, 244.0, 244.0], [146.0, 197.0, 222.0], [67.0, 147.0, 195.0], [5.0, 48.0, 97.0]];
const LIGHT: [[f32; 3]; 4] = [[244.0, 244.0, 244.0], [253.0, 184.0, 99.0], [224.0, 120.0, 20.0], [127.0, 42.0, 4.0]];

/// sRGB of `difference`, test minus truth, -1 to 1; logarithmic from 1/1024 up, because errors span three decades.
/// `None` is a pixel that was not compared.
pub fn colour(difference: Option<f32>) -> [u8; 3] {
    let Some(difference) = difference else { return NOT_COMPARED };
    if difference.is_nan() {
        return NOT_A_NUMBER;
    }
    let size = difference.abs().min(1.0);
    let place = if size < LEAST { 0.0 } else { 0.12 + 0.88 * (1.0 - size.ln() / LEAST.ln()) };
    let ramp = if difference < 0.0 { &DARK } else { &LIGHT };
    let along = place * (ramp.len() - 1) as f32;
    let index = (along as usize).min(ramp.len() - 2);
    let share = along - index as f32;
    [0, 1, 2].map(|channel| (ramp[index][channel] * (1.0 - share) + ramp[index + 1][channel] * share).round() as u8)
}

/// What pages say beside the scale.
pub const DOC: &str = "visible fraction, method minus truth, logarithmic above 1/1024: blue too dark, orange too light, near white right, \
    dark grey not compared, magenta not a number";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_fixed_ordered_and_signed() {
        assert_eq!(colour(Some(0.0)), [244; 3]);
        assert_eq!(colour(Some(-0.0)), [244; 3]);
        assert_eq!((colour(Some(1.0)), colour(Some(7.0))), ([127, 42, 4], [127, 42, 4]));
        assert_eq!(colour(Some(-1.0)), [5, 48, 97]);
        assert_eq!((colour(None), colour(Some(f32::NAN))), (NOT_COMPARED, NOT_A_NUMBER));
        let brightness = |value: f32| colour(Some(value)).map(u32::from).iter().sum::<u32>();
        for sign in [1.0, -1.0] {
            let steps: Vec<u32> = (0..=10).map(|power| brightness(sign * 2f32.powi(power - 10))).collect();
            assert!(steps.windows(2).all(|pair| pair[0] > pair[1]), "{steps:?}");
            assert!(brightness(sign / 1024.0) < 732, "one of 1024 bits is seen");
        }
    }
}
