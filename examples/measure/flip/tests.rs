//! Controls, and agreement with two other implementations of FLIP: the crate `nv-flip` (C++, live) and the package `flip-evaluator` 1.7
//! (figures below).

use super::*;

const WIDTH: usize = 48;
const HEIGHT: usize = 40;

/// Tiles under a light with a shadow edge across: `edge` is where it begins, `width` how soft it is, both in pixels.
fn picture(edge: f64, width: f64) -> Array {
    let mut texels = Vec::new();
    for (y, x) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (y, x))) {
        let albedo = if (x / 4 + y / 4) % 2 == 1 { [0.8, 0.6, 0.4] } else { [0.3, 0.5, 0.7] };
        let lit = ((x as f64 + y as f64 / 2.0 - edge) / width).clamp(0.0, 1.0);
        texels.extend(albedo.map(|albedo| (albedo * (0.08 + 3.0 * lit)) as f32));
        texels.push(1.0);
    }
    Array::f32([HEIGHT, WIDTH, 4], texels)
}

fn with(mut image: Array, column: usize, row: usize, value: f32) -> Array {
    let at = (row * WIDTH + column) * 4;
    image.words_mut()[at..at + 3].fill(value.to_bits());
    image
}

fn truth() -> Array {
    picture(20.0, 12.0)
}

/// The edge a pixel further, two thirds as soft, and a speck of light.
fn test() -> Array {
    with(picture(21.0, 8.0), 40, 10, 20.0)
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-6, "{found} is not {expected}");
}

/// In Python, NumPy 2.4.6, with `picture` and `with` as here, `shown = 0.1313460482240377` stops by the curve of `tone.rs`:
/// `evaluate(show(truth), show(test), "LDR", applyMagma=False)` and `evaluate(truth, test, "HDR", applyMagma=False)`; the mean of the
/// map in 64-bit numbers.
#[test]
fn both_kinds_agree_with_flip_evaluator() {
    let found = tone_mapped(&test(), &truth(), DEFAULT_PPD).unwrap();
    near(found.exposure.stops, 0.131_346_048_224_037_7);
    near(found.flip.mean, 0.065_296_299_063_148_07);
    near(found.flip.max, 0.429_073_393_344_878_9);
    near(tone_mapped(&test(), &truth(), 30.0).unwrap().flip.mean, 0.062_615_758_750_876_56);
    let found = high_range(&test(), &truth(), DEFAULT_PPD).unwrap();
    near(found.flip.mean, 0.067_837_541_726_093_53);
    near(found.flip.max, 0.451_389_580_965_042_1);
    near(f64::from(found.stops[0]), 0.131_346_583_366_394_04);
    near(f64::from(found.stops[1]), 0.543_752_610_683_441_2);
    assert_eq!(found.exposures_count, 2);
}

#[test]
fn what_is_shown_agrees_with_nv_flip_to_the_rounding_of_bytes() {
    // nv-flip takes bytes: rounding them costs up to half of 1/255 a channel.
    let found = tone_mapped(&test(), &truth(), nv_flip::DEFAULT_PIXELS_PER_DEGREE).unwrap();
    let bytes = [truth(), test()].map(|image| found.exposure.show_bytes(&image).unwrap());
    let image = |bytes: &[u8]| nv_flip::FlipImageRgb8::with_data(WIDTH as u32, HEIGHT as u32, bytes);
    let map = nv_flip::flip(image(&bytes[0]), image(&bytes[1]), nv_flip::DEFAULT_PIXELS_PER_DEGREE).to_vec();
    let mean = map.iter().map(|error| f64::from(*error)).sum::<f64>() / map.len() as f64;
    assert!((found.flip.mean - mean).abs() < 2e-3, "{} is not {mean}", found.flip.mean);
    // On the same bytes they are one.
    let [truth, test] = bytes.map(|bytes| RgbImage::new(WIDTH, HEIGHT, bytes).unwrap());
    let same = flip_rs::ldr_flip(&truth, &test, nv_flip::DEFAULT_PIXELS_PER_DEGREE).unwrap().into_pixels();
    let furthest = same.iter().zip(&map).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(furthest < 1e-5 && mean > 0.05, "{furthest}, mean {mean}");
}

#[test]
fn colors_are_those_of_nv_flip() {
    let errors: Vec<f32> = (0..256).map(|step| step as f32 / 255.0).collect();
    let flip = Flip::of(ErrorMap::new(256, 1, errors.clone()).unwrap());
    let colors = nv_flip::FlipImageFloat::with_data(256, 1, &errors).apply_color_lut(&nv_flip::magma_lut()).to_vec();
    let furthest = flip.colors().iter().zip(&colors).map(|(a, b)| a.abs_diff(*b)).max();
    // nv-flip cuts where this rounds.
    assert!(furthest <= Some(1) && colors.len() == 768, "{furthest:?}");
    let found = tone_mapped(&test(), &truth(), DEFAULT_PPD).unwrap().flip.colors();
    assert_eq!(found.len(), WIDTH * HEIGHT * 3);
    // evaluate(.., applyMagma=True)
    let pixel = |column: usize, row: usize| &found[(row * WIDTH + column) * 3..][..3];
    assert_eq!((pixel(40, 10), pixel(0, 0), pixel(15, 20)), (&[24, 15, 61][..], &[0, 0, 4][..], &[59, 15, 112][..]));
}

#[test]
fn identity_is_zero() {
    let shown = tone_mapped(&truth(), &truth(), DEFAULT_PPD).unwrap().flip;
    let high = high_range(&truth(), &truth(), DEFAULT_PPD).unwrap().flip;
    assert_eq!((shown.mean, shown.max, high.mean, high.max), (0.0, 0.0, 0.0, 0.0));
    assert_eq!(shown.size, [WIDTH, HEIGHT]);
}

#[test]
fn a_planted_speck_is_found_where_it_is_and_a_larger_fault_is_worse() {
    let speck = tone_mapped(&with(truth(), 30, 5, 0.0), &truth(), DEFAULT_PPD).unwrap().flip;
    let [column, row] = speck.worst_pixel;
    assert!(speck.max > 0.1 && column.abs_diff(30) <= 1 && row.abs_diff(5) <= 1, "{} {column} {row}", speck.max);
    let mean = |edge| tone_mapped(&picture(edge, 12.0), &truth(), DEFAULT_PPD).unwrap().flip.mean;
    assert!(0.0 < mean(20.25) && mean(20.25) < mean(21.0) && mean(21.0) < mean(24.0));
}

#[test]
fn a_shift_of_the_picture_by_one_pixel_is_seen() {
    let texels: Vec<f32> =
        truth().as_f32().chunks_exact(WIDTH * 4).flat_map(|row| [&row[..4], &row[..WIDTH * 4 - 4]].concat()).collect();
    let shifted = Array::f32([HEIGHT, WIDTH, 4], texels);
    assert!(tone_mapped(&shifted, &truth(), DEFAULT_PPD).unwrap().flip.mean > 0.02);
    assert!(high_range(&shifted, &truth(), DEFAULT_PPD).unwrap().flip.mean > 0.02);
}

#[test]
fn swapped_the_exposure_is_another() {
    let bright = Array::f32([HEIGHT, WIDTH, 4], truth().as_f32().iter().map(|value| value * 2.0).collect());
    let [one, other] = [[&bright, &truth()], [&truth(), &bright]].map(|[test, truth]| {
        let shown = tone_mapped(test, truth, DEFAULT_PPD).unwrap();
        (shown.exposure.stops, shown.flip.mean)
    });
    assert!((one.0 - other.0 - 1.0).abs() < 1e-6, "{one:?} {other:?}");
    assert!(one.1 > 0.05 && other.1 > 0.05 && (one.1 - other.1).abs() > 1e-3, "too bright is seen: {one:?} {other:?}");
    // evaluate(test, truth, "HDR", applyMagma=False)
    near(high_range(&truth(), &test(), DEFAULT_PPD).unwrap().flip.mean, 0.086_060_748_454_826_93);
}

#[test]
fn coverage_is_not_looked_at() {
    let mut clear = truth();
    clear.words_mut().chunks_exact_mut(4).for_each(|texel| texel[3] = f32::NAN.to_bits());
    assert_eq!(tone_mapped(&clear, &truth(), DEFAULT_PPD).unwrap().flip.mean, 0.0);
}

#[test]
fn what_is_no_picture_is_refused_by_both() {
    type Judge = fn(&Array, &Array) -> Result<f64, Problem>;
    let judges: [Judge; 2] = [
        |test, truth| Ok(tone_mapped(test, truth, DEFAULT_PPD)?.flip.mean),
        |test, truth| Ok(high_range(test, truth, DEFAULT_PPD)?.flip.mean),
    ];
    for judge in judges {
        for value in [f32::NAN, f32::INFINITY, -0.5] {
            let bad = with(truth(), 7, 3, value);
            for problem in [judge(&bad, &truth()).unwrap_err(), judge(&truth(), &bad).unwrap_err()] {
                assert!(problem.to_string().contains("at column 7, row 3"), "{problem}");
            }
            assert!(judge(&bad, &truth()).unwrap_err().to_string().starts_with("the test is no picture"));
        }
        let turned = Array::f32([WIDTH, HEIGHT, 4], truth().as_f32().to_vec());
        assert_eq!(
            judge(&turned, &truth()).unwrap_err().to_string(),
            "pictures of test and truth cannot be compared; expected 48 x 40, as the truth; found 40 x 48"
        );
        let integers = Array::zeros(Element::U32, [HEIGHT, WIDTH, 4]);
        let empty = Array::zeros(Element::F32, [0, 0, 4]);
        let grey = Array::zeros(Element::F32, [HEIGHT, WIDTH, 1]);
        for bad in [integers, empty, grey] {
            assert!(judge(&bad, &truth()).is_err() && judge(&truth(), &bad).is_err() && judge(&bad, &bad).is_err());
        }
    }
    let blinding = with(truth(), 7, 3, 1e25);
    assert!(high_range(&blinding, &truth(), DEFAULT_PPD).unwrap_err().to_string().contains("radiance 1e25"));
    assert!(tone_mapped(&blinding, &truth(), DEFAULT_PPD).unwrap().flip.max > 0.1);
    assert!(tone_mapped(&truth(), &truth(), 0.0).is_err());
    assert!(high_range(&truth(), &truth(), f32::NAN).is_err());
}

#[test]
fn black_pictures_have_an_answer_or_a_reason() {
    let black = Array::zeros(Element::F32, [HEIGHT, WIDTH, 4]);
    assert_eq!(tone_mapped(&black, &black, DEFAULT_PPD).unwrap().flip.mean, 0.0);
    assert!(tone_mapped(&truth(), &black, DEFAULT_PPD).unwrap().flip.mean > 0.3);
    assert!(tone_mapped(&black, &truth(), DEFAULT_PPD).unwrap().flip.mean > 0.3);
    assert!(high_range(&truth(), &black, DEFAULT_PPD).unwrap_err().to_string().contains("black all over"));
    assert!(high_range(&black, &truth(), DEFAULT_PPD).unwrap().flip.mean > 0.3);
}
