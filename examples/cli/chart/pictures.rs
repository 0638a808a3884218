//! Pictures of a variant: what it shaded, where it is wrong, and the scene's most telling penumbra enlarged.

use super::store::PICTURES;
use crate::answers::{Answers, Truth, is_one_surface, rows_by_pixel};
use crate::compare::picture::differences;
use crate::picture::{rgb_bytes, write_rgb};
use shadowgraph_charts::error_map::colour;
use shadowgraph_charts::model::{Pictures, Point};
use shadowgraph_core::problem::Problem;
use std::path::Path;

/// Pixels a side that a close-up shows.
const CLOSEUP_PX: usize = 40;
/// Pixels in place of one of them.
const ENLARGED: usize = 4;

/// Writes the pictures of a point into `folder` and names them. Those of the truth are one for all variants
/// of a scene with the same `truth_number`.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    folder: &Path,
    point: &Point,
    truth_number: &str,
    answers: &Answers,
    truth: &Truth,
) -> Result<Pictures, Problem> {
    let size = answers.size;
    let [left, top] = telling(&truth.grey);
    let mut pictures = Pictures::default();
    let save = |kind: &str, stem: &str, bytes: &[u8], [width, height]: [usize; 2]| {
        let name = format!("{PICTURES}/{stem}.{kind}.png");
        write_rgb(&folder.join(&name), width, height, bytes)?;
        Ok::<_, Problem>(Some(name))
    };
    let error: Vec<u8> = differences(answers, &truth.grey).into_iter().flat_map(colour).collect();
    let (close, close_size) = cut(&error, size, [left, top]);
    pictures.error = save("error", &point.id, &error, size)?;
    pictures.closeup_error = save("closeup-error", &point.id, &close, close_size)?;
    if let Some(image) = &answers.image {
        let bytes = rgb_bytes(image);
        let (close, close_size) = cut(&bytes, size, [left, top]);
        pictures.picture = save("picture", &point.id, &bytes, size)?;
        pictures.closeup_picture = save("closeup", &point.id, &close, close_size)?;
    }
    if let Some(image) = &truth.grey.image {
        let stem = format!("{}-{}-{truth_number}", plain(&point.scene), plain(&point.view));
        let bytes = rgb_bytes(image);
        let (close, close_size) = cut(&bytes, size, [left, top]);
        pictures.truth = save("truth", &stem, &bytes, size)?;
        pictures.closeup_truth = save("closeup-truth", &stem, &close, close_size)?;
    }
    Ok(pictures)
}

fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_ascii_alphanumeric() || letter == '_' { letter } else { '-' }).collect()
}

/// Left and top of the window in which the truth changes most from pixel to pixel: where a shadow's edge is, soft or hard.
fn telling(truth: &Answers) -> [usize; 2] {
    let [width, height] = truth.size;
    let visible = truth.picture(&truth.fractions());
    let row_of = rows_by_pixel(truth);
    let change = |x: usize, y: usize| {
        let here = y * width + x;
        // Both sides of an edge count, so that a window shows both.
        let beside = [y * width + (x + 1).min(width - 1), y * width + x.saturating_sub(1)];
        let across = [(y + 1).min(height - 1) * width + x, y.saturating_sub(1) * width + x];
        // What changes with the surface says nothing about shadows.
        let one = |other: usize| match (row_of[here], row_of[other]) {
            (Some(a), Some(b)) if is_one_surface(truth, a, b) => (visible[here] - visible[other]).abs(),
            _ => 0.0,
        };
        f64::from(beside.into_iter().chain(across).map(one).sum::<f32>()).sqrt()
    };
    // Sums over all windows from the sums over rectangles that begin at the corner.
    let mut sums = vec![0.0; (width + 1) * (height + 1)];
    for y in 0..height {
        for x in 0..width {
            let [above, left, both] = [y * (width + 1) + x + 1, (y + 1) * (width + 1) + x, y * (width + 1) + x];
            sums[(y + 1) * (width + 1) + x + 1] = change(x, y) + sums[above] + sums[left] - sums[both];
        }
    }
    let (across, down) = (CLOSEUP_PX.min(width), CLOSEUP_PX.min(height));
    let mut best = ([0, 0], -1.0);
    for y in 0..=height - down {
        for x in 0..=width - across {
            let at = |x: usize, y: usize| sums[y * (width + 1) + x];
            let sum = at(x + across, y + down) - at(x, y + down) - at(x + across, y) + at(x, y);
            if sum > best.1 {
                best = ([x, y], sum);
            }
        }
    }
    best.0
}

/// The window at `left, top` of packed RGB, each pixel enlarged.
fn cut(bytes: &[u8], [width, height]: [usize; 2], [left, top]: [usize; 2]) -> (Vec<u8>, [usize; 2]) {
    let size = [CLOSEUP_PX.min(width) * ENLARGED, CLOSEUP_PX.min(height) * ENLARGED];
    let texel = |at: usize| {
        let (x, y) = (left + at % size[0] / ENLARGED, top + at / size[0] / ENLARGED);
        [0, 1, 2].map(|channel| bytes[(y * width + x) * 3 + channel])
    };
    ((0..size[0] * size[1]).flat_map(texel).collect(), size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowgraph_core::array::Array;
    use shadowgraph_core::shared::KEPT;

    /// A floor of which each pixel sees a triangle of its own, in shadow from column 70 on; column 10 is a step without a shadow's edge.
    #[test]
    fn the_most_telling_window_is_at_a_shadows_edge_on_fine_meshes_too() {
        let size = [100, 60];
        let count = size[0] * size[1];
        let at = |pixel: usize| [(pixel % size[0]) as f32, (pixel / size[0]) as f32];
        let corner = |pixel: usize| [at(pixel)[0], at(pixel)[1], if at(pixel)[0] < 10.0 { 9.0 } else { 0.0 }];
        let light = |pixel: usize| if (10.0..70.0).contains(&at(pixel)[0]) { 1.0 } else { 0.0 };
        let truth = Answers {
            position: Array::f32([count, 3], (0..count).flat_map(corner).collect::<Vec<f32>>()),
            normal: Array::f32([count, 3], (0..count).flat_map(|_| [0.0, 0.0, 1.0]).collect::<Vec<f32>>()),
            triangle: Array::u32([count], (0..count as u32).collect::<Vec<u32>>()),
            pixel: Array::u32([count], (0..count as u32).collect::<Vec<u32>>()),
            state: Array::u32([count], vec![KEPT; count]),
            mask: None,
            visible: Some(Array::f32([count], (0..count).map(light).collect::<Vec<f32>>())),
            image: None,
            light_samples: 1,
            size,
        };
        let [left, _] = telling(&truth);
        assert!(left < 70 && left + CLOSEUP_PX > 70, "the edge is not in the window from {left} on");
    }

    #[test]
    fn a_cut_is_enlarged_from_its_corner() {
        let bytes: Vec<u8> = (0..50 * 45).flat_map(|pixel: u32| [(pixel % 50) as u8, (pixel / 50) as u8, 7]).collect();
        let (close, size) = cut(&bytes, [50, 45], [3, 5]);
        assert_eq!(size, [160, 160]);
        assert_eq!(close[..3], [3, 5, 7]);
        assert_eq!(close[close.len() - 3..], [42, 44, 7]);
    }
}
