//! Where a shadow's edge is, to close in on.

use crate::answers::Answers;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::KEPT;

/// Position of a view-sample at a shadow's edge: of two neighbours in a row, one lit and one not, on one triangle, that are nearest to
/// the middle of the picture.
///
/// # Errors
/// There is none.
pub fn nearest_to_the_middle(truth: &Answers) -> Result<[f32; 3], Problem> {
    let [width, height] = truth.size;
    let mut row_of = vec![None; width * height];
    for (row, pixel) in truth.pixel.as_u32().iter().enumerate() {
        row_of[*pixel as usize] = Some(row);
    }
    let (states, triangles, fractions) = (truth.state.as_u32(), truth.triangle.as_u32(), truth.fractions());
    let is_edge = |a: usize, b: usize| {
        let is_kept = |row: usize| states[row] == KEPT;
        is_kept(a) && is_kept(b) && triangles[a] == triangles[b] && (fractions[a] > 0.5) != (fractions[b] > 0.5)
    };
    let far = |pixel: usize| {
        let (x, y) = ((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5);
        (x - width as f64 / 2.0).hypot(y - height as f64 / 2.0)
    };
    let edges = (0..width * height).filter(|pixel| pixel % width + 1 < width).filter_map(|pixel| {
        let (a, b) = (row_of[pixel]?, row_of[pixel + 1]?);
        is_edge(a, b).then_some((pixel, a))
    });
    let nearest = edges.min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
    nearest.map(|(_, row)| truth.position.as_vec3()[row]).ok_or_else(|| {
        Problem::new(Kind::Missing, "the picture shows no edge of a shadow to close in on")
            .remedy("leave the scene out of the sequence, or give it another view")
    })
}
