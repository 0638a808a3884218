//! Rank-1 lattices for any count: i/N beside multiples of an irrational number, modulo 1.
//!
//! In two dimensions the number is the golden ratio, and the points are the Fibonacci lattice; in three it is the plastic number
//! and its square, which take the golden ratio's part there (Roberts 2018, the R2 sequence).

use super::hammersley::middle;

/// 1 over the golden ratio, the root of x^2 = x + 1.
const GOLDEN: f64 = 0.618_033_988_749_894_8;
/// 1 over the plastic number, the root of x^3 = x + 1; and 1 over its square.
const PLASTIC: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Point `index` of `count`.
pub fn square(index: usize, count: usize) -> [f64; 2] {
    [middle(index, count), multiple(index, GOLDEN)]
}

/// Point `index` of `count`.
pub fn cube(index: usize, count: usize) -> [f64; 3] {
    [middle(index, count), multiple(index, PLASTIC[0]), multiple(index, PLASTIC[1])]
}

/// Starts in the middle, so that one point is the centre.
fn multiple(index: usize, number: f64) -> f64 {
    (0.5 + index as f64 * number).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_the_roots() {
        assert!((1.0 / GOLDEN - 1.0 - GOLDEN).abs() < 1e-15);
        let plastic = 1.0 / PLASTIC[0];
        assert!(
            (plastic.powi(3) - plastic - 1.0).abs() < 1e-14 && (PLASTIC[0] * PLASTIC[0] - PLASTIC[1]).abs() < 1e-15
        );
    }

    #[test]
    fn fibonacci_many_points_have_three_gaps_at_most() {
        let mut heights: Vec<f64> = (0..89).map(|index| square(index, 89)[1]).collect();
        heights.sort_by(f64::total_cmp);
        let gaps: Vec<f64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
        // The three-gap theorem: none is far from 1/N.
        assert!(gaps.iter().all(|gap| *gap > 0.6 / 89.0 && *gap < 1.9 / 89.0), "{gaps:?}");
    }
}
