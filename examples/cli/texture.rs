//! Pictures on lights: PNG files to linear RGB.

use crate::file_problem;
use shadowgraph_core::problem::{Kind, Place, Problem};
use shadowgraph_core::scene::Texture;
use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

/// Most texels: a square of 4096.
const MOST_TEXELS: u64 = 1 << 24;

/// Reads a PNG of any colour type and depth as linear RGB. Its numbers are sRGB, as PNG files are unless they say otherwise, which
/// is not looked for; a texel shines as much as it is opaque.
///
/// # Errors
/// The file cannot be read, is no PNG, or is larger than 2^24 texels.
pub fn read(path: &Path) -> Result<Texture, Problem> {
    let file = File::open(path).map_err(|error| file_problem(path, &error))?;
    decode(BufReader::new(file), path)
}

/// The same from bytes; `path` is for problems only.
///
/// # Errors
/// As [`read`].
pub fn decode(bytes: impl BufRead + Seek, path: &Path) -> Result<Texture, Problem> {
    let place = || Place { file: path.display().to_string(), line: 0, column: 0, path: String::new() };
    let wrong = |error: png::DecodingError| {
        Problem::new(Kind::Syntax, format!("not a PNG file: {error}")).at(place()).remedy("give an 8- or 16-bit PNG")
    };
    let too_large = |width: u32, height: u32| {
        Problem::new(Kind::BadValue, "the picture is too large for a light")
            .at(place())
            .expected("1 to 16777216 texels")
            .found(format!("{width}x{height}"))
            .remedy("make it smaller: each of at most 4096 light samples shows one texel")
    };
    // What a chunk may ask for, beside the picture itself.
    let limits = png::Limits { bytes: 64 << 20 };
    let mut decoder = png::Decoder::new_with_limits(bytes, limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let header = decoder.read_header_info().map_err(wrong)?;
    let (width, height) = (header.width, header.height);
    if !(1..=MOST_TEXELS).contains(&(u64::from(width) * u64::from(height))) {
        return Err(too_large(width, height));
    }
    let mut reader = decoder.read_info().map_err(wrong)?;
    let size = reader.output_buffer_size().ok_or_else(|| too_large(width, height))?;
    let mut values = vec![0; size];
    let frame = reader.next_frame(&mut values).map_err(wrong)?;
    let channels = frame.color_type.samples();
    let texels = values[..frame.buffer_size()].chunks_exact(channels).map(|texel| match *texel {
        [grey] => [linear(grey); 3],
        [grey, alpha] => [linear(grey) * opacity(alpha); 3],
        [r, g, b] => [r, g, b].map(linear),
        [r, g, b, alpha] => [r, g, b].map(|value| linear(value) * opacity(alpha)),
        _ => unreachable!("a PNG of {channels} channels"),
    });
    let texels: Vec<[f32; 3]> = texels.collect();
    Ok(Texture { width: width as usize, height: height as usize, texels })
}

fn opacity(alpha: u8) -> f32 {
    f32::from(alpha) / 255.0
}

/// IEC 61966-2-1 decoding of one value.
fn linear(value: u8) -> f32 {
    let x = f32::from(value) / 255.0;
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::io::Cursor;

    fn encoded(color: png::ColorType, width: u32, height: u32, bytes: &[u8]) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(color);
        encoder.write_header().unwrap().write_image_data(bytes).unwrap();
        file
    }

    fn texture(file: &[u8]) -> Result<Texture, Problem> {
        decode(Cursor::new(file), Path::new("mask.png"))
    }

    #[test]
    fn colour_types_are_read_and_made_linear() {
        let rgb = texture(&encoded(png::ColorType::Rgb, 2, 1, &[255, 0, 128, 0, 255, 0])).unwrap();
        assert_eq!((rgb.width, rgb.height, rgb.texels[1]), (2, 1, [0.0, 1.0, 0.0]));
        assert!((rgb.texels[0][2] - 0.215_860_5).abs() < 1e-6);
        let grey = texture(&encoded(png::ColorType::Grayscale, 1, 2, &[255, 0])).unwrap();
        assert_eq!(grey.texels, [[1.0; 3], [0.0; 3]]);
        let clear = texture(&encoded(png::ColorType::Rgba, 1, 1, &[255, 255, 255, 51])).unwrap();
        assert_eq!(clear.texels, [[0.2; 3]]);
    }

    #[test]
    fn what_is_no_picture_is_told_with_its_file() {
        let problem = texture(b"GIF89a").unwrap_err();
        assert!(problem.to_string().starts_with("mask.png: not a PNG file: "), "{problem}");
        let mut huge = encoded(png::ColorType::Rgb, 1, 1, &[0; 3]);
        huge[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
        assert!(texture(&huge).is_err());
        assert_eq!(read(Path::new("no/such.png")).unwrap_err().kind, Kind::File);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn pictures_with_damaged_chunks_end_likewise(
            damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
            is_sealed: bool,
        ) {
            let mut file = encoded(png::ColorType::Rgb, 8, 8, &[90; 8 * 8 * 3]);
            for (at, value) in damage {
                let at = at.index(file.len() - 8) + 8;
                file[at] = value;
            }
            if is_sealed {
                // The header's checksum is right again: what it says is believed.
                let sum = crc(&file[12..29]);
                file[29..33].copy_from_slice(&sum.to_be_bytes());
            }
            match texture(&file) {
                Ok(texture) => prop_assert_eq!(texture.width * texture.height, texture.texels.len()),
                Err(problem) => prop_assert!(problem.place.is_some(), "{}", problem),
            }
        }
    }

    /// The checksum of PNG chunks.
    fn crc(bytes: &[u8]) -> u32 {
        let step = |crc: u32, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
        !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
    }

    #[test]
    fn damaged_pictures_end_in_a_texture_or_a_problem() {
        let whole = encoded(png::ColorType::Rgba, 16, 16, &[200; 16 * 16 * 4]);
        // Every cut, and every byte turned over.
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 0xff;
            for file in [&whole[..at], &damaged] {
                if let Ok(texture) = texture(file) {
                    assert_eq!(texture.width * texture.height, texture.texels.len());
                }
            }
        }
    }
}
