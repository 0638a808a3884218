//! FLIP: how far two pictures look apart to someone who flips between them, 0 the same to 1.
//!
//! Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild (2020), "FLIP: a difference evaluator for alternating images",
//! Proc. ACM Comput. Graph. Interact. Tech. 3(2); Andersson, Nilsson, Shirley, Akenine-Moller (2021), "Visualizing errors in rendered
//! high dynamic range images". The computing is done by the crate `flip-rs` (version 1.7 of FLIP).
//!
//! Both functions take linear RGB radiance `[H W 4]`, as the port `image` of the stage `shade`; coverage is not looked at. Nothing is
//! rounded to bytes on the way.
//! - [`tone_mapped`]: LDR-FLIP of both pictures as a screen would show them, by one curve and one [`Exposure`] taken from the truth: an
//!   exposure of its own would hide that a picture is too bright.
//! - [`high_range`]: HDR-FLIP, the largest LDR-FLIP of each pixel over a range of exposures that FLIP takes from the truth.
//!
//! The figure to report is the mean, as FLIP's authors recommend. It depends on the truth being the truth: swapped, the exposures are
//! other ones.

mod tone;

pub use flip_rs::DEFAULT_PPD;
pub use tone::Exposure;

use flip_rs::{ErrorMap, FlipError, HdrOptions, MAGMA, RgbImage};
use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::problem::{Kind, Problem};

/// Largest exposed radiance that HDR-FLIP can square in 32-bit numbers.
const BRIGHTEST: f64 = 1e18;

/// Errors of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Flip {
    /// Mean over pixels.
    pub mean: f64,
    /// Largest of a pixel.
    pub max: f64,
    /// First pixel that has it: column and row.
    pub worst_pixel: [usize; 2],
    /// Columns and rows.
    pub size: [usize; 2],
    /// Error of every pixel `[H W]`, 0 to 1.
    pub map: Vec<f32>,
}

impl Flip {
    fn of(map: ErrorMap) -> Self {
        let size = [map.width(), map.height()];
        let map = map.into_pixels();
        let larger = |best: (usize, f32), next: (usize, f32)| if next.1 > best.1 { next } else { best };
        let (worst, max) = map.iter().copied().enumerate().fold((0, 0.0), larger);
        Self {
            mean: map.iter().map(|error| f64::from(*error)).sum::<f64>() / map.len() as f64,
            max: f64::from(max),
            worst_pixel: [worst % size[0], worst / size[0]],
            size,
            map,
        }
    }

    /// The map as packed 8-bit sRGB `[H W 3]` by FLIP's own colours, magma: black 0, pale yellow 1, in every picture alike.
    pub fn colors(&self) -> Vec<u8> {
        let color = |error: &f32| MAGMA[(error.clamp(0.0, 1.0) * 255.0 + 0.5) as usize].map(byte);
        self.map.iter().flat_map(color).collect()
    }
}

/// LDR-FLIP of pictures as they are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct ToneMapped {
    /// Errors.
    pub flip: Flip,
    /// How bright both pictures were shown.
    pub exposure: Exposure,
}

/// HDR-FLIP.
#[derive(Clone, Debug, PartialEq)]
pub struct HighRange {
    /// Errors: of each pixel the largest over the exposures.
    pub flip: Flip,
    /// First and last exposure, stops.
    pub stops: [f32; 2],
    /// Exposures from first to last.
    pub exposures_count: usize,
}

/// LDR-FLIP of linear pictures `[H W 4]`, shown by the exposure of the truth, the ACES curve of FLIP and sRGB.
/// `pixels_per_degree` says how far away the screen is: [`DEFAULT_PPD`] is 3840 pixels on 0.7 m at 0.7 m.
///
/// # Errors
/// A picture is no `[H W 4]` of floats or empty, they differ in size, a channel is negative or not finite, or the pixels per degree are
/// out of range.
pub fn tone_mapped(test: &Array, truth: &Array, pixels_per_degree: f32) -> Result<ToneMapped, Problem> {
    let exposure = Exposure::of(truth)?;
    rgb("test", test)?;
    let [test, truth] = both(test, truth, |image| exposure.show(image))?;
    let map = flip_rs::ldr_flip(&truth, &test, pixels_per_degree).map_err(problem)?;
    Ok(ToneMapped { flip: Flip::of(map), exposure })
}

/// HDR-FLIP of linear pictures `[H W 4]`, with FLIP's own range of exposures and the ACES curve. `pixels_per_degree` as in
/// [`tone_mapped`].
///
/// # Errors
/// As [`tone_mapped`]; and where the truth is black all over or spans more than 128 stops, which leaves no range of exposures, or a
/// pixel is too bright for the last of them.
pub fn high_range(test: &Array, truth: &Array, pixels_per_degree: f32) -> Result<HighRange, Problem> {
    let mut options = HdrOptions::default();
    options.ppd = pixels_per_degree;
    options.return_exposure_map = false;
    let truth_rgb = rgb("truth", truth)?;
    if truth_rgb.iter().all(|value| *value == 0.0) {
        return Err(Problem::new(Kind::BadValue, "HDR-FLIP has no exposure for a truth that is black all over")
            .expected("radiance above 0 in some pixel")
            .remedy("compare the tone-mapped pictures"));
    }
    rgb("test", test)?;
    let [test, truth] = both(test, truth, |image| rgb("picture", image))?;
    let result = flip_rs::hdr_flip(&truth, &test, options).map_err(problem)?;
    let used = result.parameters;
    // FLIP squares what it exposes in 32 bits and takes what overflows for black.
    let brightest = [&test, &truth].into_iter().flat_map(RgbImage::pixels).copied().fold(0.0, f32::max);
    if f64::from(brightest) * f64::from(used.stop_exposure).exp2() > BRIGHTEST {
        return Err(Problem::new(Kind::BadValue, "a pixel is too bright for HDR-FLIP's exposures")
            .expected(format!("at most {BRIGHTEST:e} at the last exposure, {} stops", used.stop_exposure))
            .found(format!("radiance {brightest:e}"))
            .remedy("compare the tone-mapped pictures"));
    }
    Ok(HighRange {
        flip: Flip::of(result.error_map),
        stops: [used.start_exposure, used.stop_exposure],
        exposures_count: used.num_exposures,
    })
}

/// Both pictures as FLIP wants them.
fn both(
    test: &Array,
    truth: &Array,
    channels: impl Fn(&Array) -> Result<Vec<f32>, Problem>,
) -> Result<[RgbImage<f32>; 2], Problem> {
    if test.shape() != truth.shape() {
        return Err(Problem::new(Kind::BadValue, "pictures of test and truth cannot be compared")
            .expected(format!("{} x {}, as the truth", truth.dim(1), truth.dim(0)))
            .found(format!("{} x {}", test.dim(1), test.dim(0))));
    }
    let image = |image: &Array| RgbImage::new(image.dim(1), image.dim(0), channels(image)?).map_err(problem);
    Ok([image(test)?, image(truth)?])
}

/// The colour channels of a picture, checked.
fn rgb(whose: &str, image: &Array) -> Result<Vec<f32>, Problem> {
    let wrong = |expected: &str, found: String| {
        Problem::new(Kind::BadValue, format!("the {whose} is no picture for FLIP")).expected(expected).found(found)
    };
    if image.element() != Element::F32 || image.shape().len() != 3 || image.dim(2) != 4 || image.words().is_empty() {
        return Err(wrong("floats [H W 4]", format!("{:?} {:?}", image.element(), image.shape())));
    }
    let texels = image.as_f32().chunks_exact(4);
    let bad = |texel: &[f32]| texel[..3].iter().any(|value| !(value.is_finite() && *value >= 0.0));
    if let Some(index) = texels.clone().position(bad) {
        let place = format!("column {}, row {}", index % image.dim(1), index / image.dim(1));
        let texel = &image.as_f32()[index * 4..index * 4 + 3];
        return Err(wrong("finite radiance of 0 and more", format!("{texel:?} at {place}")));
    }
    Ok(texels.flat_map(|texel| [texel[0], texel[1], texel[2]]).collect())
}

fn byte(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// FLIP's own refusals: of what this module does not check.
fn problem(error: FlipError) -> Problem {
    Problem::new(Kind::BadValue, format!("FLIP cannot compare these pictures: {error}"))
}

#[cfg(test)]
mod tests;
