//! Stratified points for any count: N boxes of volume 1/N that fill the square or cube, one random point in each.
//!
//! Slabs along the first axis are as wide as the share of boxes that they hold, so that counts without a whole root need no special
//! case: 7 points are slabs of 2, 2 and 3 boxes that are 2/7, 2/7 and 3/7 wide.

use crate::random::Random;
use std::ops::Range;

/// One point in each of `count` boxes of the unit square.
pub fn square(count: usize, random: &mut Random) -> Vec<[f64; 2]> {
    let mut points = Vec::with_capacity(count);
    for slab in slabs(count, (count as f64).sqrt().round() as usize) {
        let (start, end) = (slab.start as f64 / count as f64, slab.end as f64 / count as f64);
        for row in 0..slab.len() {
            points.push([between(start, end, random), in_step(row, slab.len(), random)]);
        }
    }
    points
}

/// One point in each of `count` boxes of the unit cube.
pub fn cube(count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let mut points = Vec::with_capacity(count);
    for slab in slabs(count, (count as f64).cbrt().round() as usize) {
        let (start, end) = (slab.start as f64 / count as f64, slab.end as f64 / count as f64);
        for [y, z] in square(slab.len(), random) {
            points.push([between(start, end, random), y, z]);
        }
    }
    points
}

/// `0..count` cut into `parts` ranges whose lengths differ by one at most; none is empty.
fn slabs(count: usize, parts: usize) -> impl Iterator<Item = Range<usize>> {
    let parts = parts.clamp(1, count.max(1));
    (0..parts).map(move |part| part * count / parts..(part + 1) * count / parts).filter(|range| !range.is_empty())
}

fn between(low: f64, high: f64, random: &mut Random) -> f64 {
    // Rounding may meet the upper end, which belongs to the next box.
    (low + (high - low) * random.unit()).min(high.next_down())
}

fn in_step(step: usize, steps: usize, random: &mut Random) -> f64 {
    between(step as f64 / steps as f64, (step + 1) as f64 / steps as f64, random)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seven_boxes_counted_by_hand() {
        assert_eq!(slabs(7, 3).collect::<Vec<_>>(), [0..2, 2..4, 4..7]);
        let points = square(7, &mut Random::new(3));
        let bounds = [0.0, 2.0 / 7.0, 4.0 / 7.0, 1.0];
        let column = |x: f64| (0..3).find(|column| x < bounds[column + 1]).unwrap_or(3);
        let boxes: Vec<(usize, usize)> = points
            .iter()
            .map(|[x, y]| {
                let rows = [2.0, 2.0, 3.0][column(*x)];
                (column(*x), (y * rows) as usize)
            })
            .collect();
        assert_eq!(boxes, [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)]);
    }

    #[test]
    fn a_square_number_is_the_usual_grid() {
        let mut seen = [0; 64];
        for [x, y] in square(64, &mut Random::new(1)) {
            seen[(x * 8.0) as usize * 8 + (y * 8.0) as usize] += 1;
        }
        assert_eq!(seen, [1; 64]);
        let mut seen = [0; 64];
        for [x, y, z] in cube(64, &mut Random::new(1)) {
            seen[(x * 4.0) as usize * 16 + (y * 4.0) as usize * 4 + (z * 4.0) as usize] += 1;
        }
        assert_eq!(seen, [1; 64]);
    }
}
