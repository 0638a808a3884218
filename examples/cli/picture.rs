//! Linear pictures to files: EXR keeps the numbers, PNG is for looking.

use crate::file_problem;
use exr::prelude::write_rgba_file;
use shadowgraph_core::array::Array;
use shadowgraph_core::problem::{Kind, Problem};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Writes `image` `[H, W, 4]` linear as EXR, four 32-bit float channels.
///
/// # Errors
/// The file cannot be written.
pub fn write_exr(path: &Path, image: &Array) -> Result<(), Problem> {
    let (height, width) = (image.dim(0), image.dim(1));
    let values = image.as_f32();
    let pixel = |x: usize, y: usize| {
        let at = (y * width + x) * 4;
        (values[at], values[at + 1], values[at + 2], values[at + 3])
    };
    write_rgba_file(path, width, height, pixel)
        .map_err(|error| Problem::new(Kind::File, error.to_string()).found(path.display().to_string()))
}

/// Writes `image` `[H, W, 4]` as 8-bit sRGB, opaque, clipped to 0..=1.
///
/// # Errors
/// The file cannot be written.
pub fn write_png(path: &Path, image: &Array) -> Result<(), Problem> {
    write_rgb(path, image.dim(1), image.dim(0), &rgb_bytes(image))
}

/// `image` `[H, W, 4]` as packed 8-bit sRGB, clipped to 0..=1.
pub fn rgb_bytes(image: &Array) -> Vec<u8> {
    image.as_f32().chunks_exact(4).flat_map(|texel| [texel[0], texel[1], texel[2]]).map(srgb).collect()
}

/// Writes packed 8-bit RGB.
///
/// # Errors
/// The file cannot be written.
pub fn write_rgb(path: &Path, width: usize, height: usize, bytes: &[u8]) -> Result<(), Problem> {
    let io = || -> Result<(), png::EncodingError> {
        let file = BufWriter::new(File::create(path)?);
        let mut encoder = png::Encoder::new(file, width as u32, height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.write_header()?.write_image_data(bytes)
    };
    io().map_err(|error| file_problem(path, &std::io::Error::other(error.to_string())))
}

/// IEC 61966-2-1 encoding of one linear value.
fn srgb(linear: f32) -> u8 {
    let x = linear.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_meets_its_fixed_points() {
        assert_eq!([srgb(0.0), srgb(1.0), srgb(2.0), srgb(-1.0), srgb(f32::NAN)], [0, 255, 255, 0, 0]);
        assert_eq!(srgb(0.214_041_14), 128);
    }
}
