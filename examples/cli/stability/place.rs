//! The failing place: where most is wrong, and pictures of it.

use crate::answers::Answers;
use crate::picture::write_rgb;
use shadowgraph_charts::error_map;
use shadowgraph_charts::model::Worst;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::NO_TRIANGLE;
use std::path::Path;

/// Pixels a side of the picture of a place.
const SIDE_PX: usize = 28;
/// How much it is enlarged; a pixel stays a square.
const ENLARGED: usize = 8;
/// Wrongness is summed over squares that reach so far from their middle.
const REACH_PX: usize = 4;

/// The pixel around which most is wrong; none where nothing is. `wrong` is by row of `answers`.
pub fn find(answers: &Answers, wrong: &[f32]) -> Option<[usize; 2]> {
    let [width, height] = answers.size;
    // Sums over rectangles from the corner, one row and one column larger than the picture.
    let mut sums = vec![0.0f64; (width + 1) * (height + 1)];
    let at = |x: usize, y: usize| y * (width + 1) + x;
    for (pixel, wrong) in answers.pixel.as_u32().iter().zip(wrong) {
        let pixel = *pixel as usize;
        if pixel < width * height {
            sums[at(pixel % width + 1, pixel / width + 1)] = f64::from(*wrong);
        }
    }
    for y in 1..=height {
        for x in 1..=width {
            sums[at(x, y)] += sums[at(x - 1, y)] + sums[at(x, y - 1)] - sums[at(x - 1, y - 1)];
        }
    }
    let around = |[x, y]: [usize; 2]| {
        let (left, right) = (x.saturating_sub(REACH_PX), (x + REACH_PX + 1).min(width));
        let (top, bottom) = (y.saturating_sub(REACH_PX), (y + REACH_PX + 1).min(height));
        sums[at(right, bottom)] - sums[at(left, bottom)] - sums[at(right, top)] + sums[at(left, top)]
    };
    let wrong_pixels = answers.pixel.as_u32().iter().zip(wrong).filter(|(_, wrong)| **wrong > 0.0);
    let places = wrong_pixels.map(|(pixel, _)| [*pixel as usize % width, *pixel as usize / width]);
    places.max_by(|a, b| around(*a).total_cmp(&around(*b)))
}

/// Writes what the method shows around `pixel`, what is right, and the difference on the scale of all pages, as
/// `FOLDER/STEM.{method,truth,error}.png`; names in what is returned are relative to `root`.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    root: &Path,
    folder: &str,
    stem: &str,
    frame: usize,
    pixel: [usize; 2],
    test: &Answers,
    truth: &Answers,
) -> Result<Worst, Problem> {
    let [width, height] = test.size;
    // Without view-samples: the colour of what was not compared.
    let (mut seen, mut right) = (vec![None; width * height], vec![None; width * height]);
    let compared = |row: usize| test.is_compared(truth, row);
    let fractions = (test.fractions(), truth.fractions());
    for (row, at) in test.pixel.as_u32().iter().map(|pixel| *pixel as usize).enumerate() {
        if test.triangle.as_u32()[row] != NO_TRIANGLE && at < width * height {
            seen[at] = Some((fractions.0[row], compared(row)));
            right[at] = Some((fractions.1[row], compared(row)));
        }
    }
    let grey = |value: Option<(f32, bool)>| match value {
        // Visible fractions are shown as they are: no curve is laid over them.
        Some((fraction, _)) => [(fraction.clamp(0.0, 1.0) * 255.0).round() as u8; 3],
        None => error_map::NOT_COMPARED,
    };
    let crop = Crop::around(pixel, test.size);
    let name = |what: &str| format!("{folder}/{stem}.{what}.png");
    let picture = |what: &str, color: &dyn Fn(usize) -> [u8; 3]| {
        let bytes = crop.enlarged(width, color);
        write_rgb(&root.join(name(what)), crop.size[0] * ENLARGED, crop.size[1] * ENLARGED, &bytes)
    };
    picture("method", &|at| grey(seen[at]))?;
    picture("truth", &|at| grey(right[at]))?;
    picture("error", &|at| {
        let both = seen[at].zip(right[at]).filter(|((_, compared), _)| *compared);
        error_map::colour(both.map(|((seen, _), (right, _))| seen - right))
    })?;
    let (picture, truth, error) = (Some(name("method")), Some(name("truth")), Some(name("error")));
    Ok(Worst { frame, pixel, picture, truth, error })
}

/// A part of a picture.
struct Crop {
    corner: [usize; 2],
    size: [usize; 2],
}

impl Crop {
    fn around(pixel: [usize; 2], image: [usize; 2]) -> Self {
        let size = image.map(|side| side.min(SIDE_PX));
        let corner = [0, 1].map(|k| pixel[k].saturating_sub(size[k] / 2).min(image[k] - size[k]));
        Self { corner, size }
    }

    fn enlarged(&self, width: usize, color: &dyn Fn(usize) -> [u8; 3]) -> Vec<u8> {
        let [left, top] = self.corner;
        let rows = (0..self.size[1] * ENLARGED).map(|y| top + y / ENLARGED);
        let pixels = rows.flat_map(|y| (0..self.size[0] * ENLARGED).map(move |x| y * width + left + x / ENLARGED));
        pixels.flat_map(color).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crops_stay_inside_the_picture_and_pixels_become_squares() {
        let crop = Crop::around([0, 95], [128, 96]);
        assert_eq!((crop.corner, crop.size), ([0, 68], [28, 28]));
        assert_eq!(Crop::around([1, 1], [3, 2]).size, [3, 2]);
        let crop = Crop { corner: [1, 0], size: [1, 1] };
        let bytes = crop.enlarged(3, &|at| [at as u8; 3]);
        assert_eq!(bytes, vec![1; ENLARGED * ENLARGED * 3]);
    }
}
