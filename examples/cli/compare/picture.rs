//! Differences of visible fractions as pictures, at one scale for all, so that two pictures can be laid side by side.

use crate::answers::Answers;
use crate::picture::write_rgb;
use shadowgraph_core::problem::Problem;
use std::path::Path;

/// Writes `test` minus `truth`: grey where they agree, blue where the test is too dark, red where it is too light; full colour at a
/// difference of 1. The colour grows with the square root, so that one light sample of 256 can be seen.
///
/// # Errors
/// The file cannot be written.
pub fn write_difference(path: &Path, test: &Answers, truth: &Answers) -> Result<(), Problem> {
    let (seen, right) = (test.picture(&test.fractions()), truth.picture(&truth.fractions()));
    let bytes: Vec<u8> = seen.iter().zip(&right).flat_map(|(seen, right)| color(*seen, *right)).collect();
    write_rgb(path, test.size[0], test.size[1], &bytes)
}

/// Colour of a difference over the truth in grey.
pub fn color(seen: f32, right: f32) -> [u8; 3] {
    let error = (seen - right).clamp(-1.0, 1.0);
    let ground = 96.0 + 96.0 * right.clamp(0.0, 1.0);
    let full = if error > 0.0 { [214.0, 39.0, 40.0] } else { [31.0, 90.0, 200.0] };
    let share = error.abs().sqrt();
    full.map(|full: f32| (ground + (full - ground) * share).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agreement_is_grey_and_either_error_has_its_colour() {
        assert_eq!(color(0.5, 0.5), [144; 3]);
        assert_eq!(color(1.0, 0.0), [214, 39, 40]);
        assert_eq!(color(0.0, 1.0), [31, 90, 200]);
        let [red, green, blue] = color(0.5 + 1.0 / 256.0, 0.5);
        assert!(red > green && green >= blue && red < 160);
    }
}
