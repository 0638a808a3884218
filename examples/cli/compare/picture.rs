//! Differences of visible fractions as pictures, at one scale for all, so that two pictures can be laid side by side.

use crate::answers::Answers;
use crate::picture::write_rgb;
use shadowgraph_charts::error_map::colour;
use shadowgraph_core::problem::Problem;
use std::path::Path;

/// Writes `test` minus `truth` in the colours of [`shadowgraph_charts::error_map`].
///
/// # Errors
/// The file cannot be written.
pub fn write_difference(path: &Path, test: &Answers, truth: &Answers) -> Result<(), Problem> {
    let bytes: Vec<u8> = differences(test, truth).into_iter().flat_map(colour).collect();
    write_rgb(path, test.size[0], test.size[1], &bytes)
}

/// `test` minus `truth` by pixel; none where no view-sample was compared.
pub fn differences(test: &Answers, truth: &Answers) -> Vec<Option<f32>> {
    let mut picture = vec![None; test.size[0] * test.size[1]];
    let (seen, right) = (test.fractions(), truth.fractions());
    for (row, pixel) in test.pixel.as_u32().iter().enumerate().filter(|(row, _)| test.is_compared(truth, *row)) {
        if let Some(texel) = picture.get_mut(*pixel as usize) {
            *texel = Some(seen[row] - right[row]);
        }
    }
    picture
}
