//! Hammersley points: i/N beside van der Corput sequences, the mirrored digits of i in bases 2 and 3.

/// Digits of `index` in `base`, mirrored at the point: a number in [0, 1).
pub fn radical_inverse(mut index: usize, base: usize) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0 / base as f64);
    while index > 0 {
        value += (index % base) as f64 * digit;
        index /= base;
        digit /= base as f64;
    }
    value
}

/// Point `index` of `count`, both coordinates in the middle of their steps.
pub fn square(index: usize, count: usize) -> [f64; 2] {
    let step = 1.0 / count as f64;
    [middle(index, count), below_one(radical_inverse(index, 2) + 0.5 * step)]
}

/// Point `index` of `count`. The second coordinate starts at 0: shapes take it for an angle, which has no middle.
pub fn cube(index: usize, count: usize) -> [f64; 3] {
    let third = below_one(radical_inverse(index, 3) + 0.5 / count as f64);
    [middle(index, count), radical_inverse(index, 2), third]
}

/// The middle of step `index` of `count` in [0, 1).
pub fn middle(index: usize, count: usize) -> f64 {
    (2 * index + 1) as f64 / (2 * count) as f64
}

/// Half a step past the last mirrored digits may reach 1 where `count` is no power of the base.
fn below_one(x: f64) -> f64 {
    if x < 1.0 { x } else { 1.0 - f64::EPSILON }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrored_digits() {
        assert_eq!([0, 1, 2, 3].map(|index| radical_inverse(index, 2)), [0.0, 0.5, 0.25, 0.75]);
        assert!((radical_inverse(5, 3) - 7.0 / 9.0).abs() < 1e-15);
    }

    #[test]
    fn four_points_counted_by_hand() {
        let points = [0, 1, 2, 3].map(|index| square(index, 4));
        assert_eq!(points, [[0.125, 0.125], [0.375, 0.625], [0.625, 0.375], [0.875, 0.875]]);
    }

    #[test]
    fn sixteen_points_fall_one_into_each_box_of_sixteen() {
        for columns in [1, 2, 4, 8, 16] {
            let mut seen = [0; 16];
            for index in 0..16 {
                let [x, y] = square(index, 16);
                seen[(x * columns as f64) as usize * (16 / columns) + (y * (16 / columns) as f64) as usize] += 1;
            }
            assert_eq!(seen, [1; 16], "{columns} columns");
        }
    }
}
