//! Hammersley points (van der Corput sequences in bases 2 and 3 beside i/N), mapped to the solid unit ball.

use glam::DVec3;

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

/// Point `index` of `count`, uniform by volume: shells of equal volume in base 3, heights i/N, angles in base 2.
pub fn in_ball(index: usize, count: usize) -> DVec3 {
    let height = 1.0 - (2 * index + 1) as f64 / count as f64;
    let angle = std::f64::consts::TAU * radical_inverse(index, 2);
    let radius = (radical_inverse(index, 3) + 0.5 / count as f64).min(1.0).cbrt();
    let across = (1.0 - height * height).max(0.0).sqrt();
    radius * DVec3::new(across * angle.cos(), across * angle.sin(), height)
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
    fn points_fill_the_ball_evenly() {
        let points: Vec<DVec3> = (0..1024).map(|index| in_ball(index, 1024)).collect();
        let inner = points.iter().filter(|point| point.length() <= 0.5f64.cbrt()).count();
        let mean = points.iter().sum::<DVec3>() / 1024.0;
        assert!(points.iter().all(|point| point.length() <= 1.0));
        assert!(inner.abs_diff(512) <= 8 && mean.length() < 0.01, "{inner} {mean}");
    }
}
