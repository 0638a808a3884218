//! How the nodes of a frame lie in time: one after another, over one another, or with gaps.

use super::MeasuredFrame;
use super::times::Times;
use serde::Serialize;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;

/// Medians over frames, milliseconds. Frames without a good reading are left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Overlap {
    /// All nodes added up.
    pub sum_millis: f64,
    /// From the first begin to the last end.
    pub span_millis: f64,
    /// Under at least one node.
    pub covered_millis: f64,
    /// Sum without what is covered: work of several nodes at once.
    pub overlapping_millis: f64,
    /// Span without what is covered: between nodes.
    pub gaps_millis: f64,
}

impl Overlap {
    /// Of these frames; none where no frame has a good reading.
    ///
    /// # Errors
    /// A time is not finite.
    pub fn of<'a>(frames: impl Iterator<Item = &'a MeasuredFrame>) -> Result<Option<Self>, Problem> {
        let each: Vec<[f64; 3]> = frames.filter_map(|frame| lengths(&frame.pieces)).collect();
        let median = |of: &dyn Fn(&[f64; 3]) -> f64| {
            let values: Vec<f64> = each.iter().map(of).collect();
            Times::of(&values).map(|times| times.map(|times| times.median))
        };
        let Some(sum_millis) = median(&|[sum, ..]| *sum)? else { return Ok(None) };
        let value = |of: &dyn Fn(&[f64; 3]) -> f64| median(of).map(Option::unwrap_or_default);
        Ok(Some(Self {
            sum_millis,
            span_millis: value(&|[_, span, _]| *span)?,
            covered_millis: value(&|[.., covered]| *covered)?,
            // Rounding must not make a negative length.
            overlapping_millis: value(&|[sum, _, covered]| (sum - covered).max(0.0))?,
            gaps_millis: value(&|[_, span, covered]| (span - covered).max(0.0))?,
        }))
    }
}

/// Sum, span, and length under at least one reading.
fn lengths(pieces: &[(usize, Reading)]) -> Option<[f64; 3]> {
    let mut spans: Vec<[f64; 2]> = pieces
        .iter()
        .filter_map(|(_, reading)| match reading {
            Reading::Span { begin, end } => Some([*begin, *end]),
            _ => None,
        })
        .collect();
    spans.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let first = spans.first()?[0];
    let (mut sum, mut covered, mut until) = (0.0, 0.0, first);
    for [begin, end] in spans {
        sum += end - begin;
        covered += (end - begin.max(until)).max(0.0);
        until = until.max(end);
    }
    Some([sum, until - first, covered])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_apart_touching_and_overlapping_nodes() {
        let of = |spans: &[[f64; 2]]| lengths(&spans.iter().map(|[a, b]| (0, Reading::of(*a, *b))).collect::<Vec<_>>());
        assert_eq!(of(&[[1.0, 2.0], [2.0, 4.0]]), Some([3.0, 3.0, 3.0]));
        assert_eq!(of(&[[3.0, 4.0], [0.0, 1.0]]), Some([2.0, 4.0, 2.0]));
        assert_eq!(of(&[[0.0, 4.0], [1.0, 2.0], [3.0, 6.0]]), Some([8.0, 6.0, 6.0]));
        assert_eq!(lengths(&[(0, Reading::Zero), (1, Reading::Dropped)]), None);
    }
}
