//! The unit square to the unit disc, the unit cube to the unit ball: equal areas and volumes stay equal.

use glam::{DVec2, DVec3, dvec2};
use std::f64::consts::{FRAC_PI_4, TAU};

/// A point of [0, 1)^2 to [-1, 1)^2.
pub fn in_square([x, y]: [f64; 2]) -> DVec2 {
    dvec2(2.0 * x - 1.0, 2.0 * y - 1.0)
}

/// A point of [0, 1)^2 to the unit disc, squares to rings without a seam (Shirley and Chiu 1997).
pub fn in_disc(point: [f64; 2]) -> DVec2 {
    let p = in_square(point);
    let (radius, angle) = if p == DVec2::ZERO {
        (0.0, 0.0)
    } else if p.x.abs() > p.y.abs() {
        (p.x, FRAC_PI_4 * (p.y / p.x))
    } else {
        (p.y, 2.0 * FRAC_PI_4 - FRAC_PI_4 * (p.x / p.y))
    };
    radius * dvec2(angle.cos(), angle.sin())
}

/// A point of [0, 1)^3 to the solid unit ball: height and angle by Archimedes, shells of equal volume by the cube root.
pub fn in_ball([x, y, z]: [f64; 3]) -> DVec3 {
    let height = 1.0 - 2.0 * x;
    let angle = TAU * y;
    let across = (1.0 - height * height).max(0.0).sqrt();
    z.cbrt() * DVec3::new(across * angle.cos(), across * angle.sin(), height)
}

/// Longitude and latitude of a direction as (u, v) in [0, 1]^2: u around y from -z, v from the top.
pub fn longitude_latitude(direction: DVec3) -> [f64; 2] {
    let d = direction.normalize_or_zero();
    [0.5 + d.x.atan2(d.z) / TAU, d.y.clamp(-1.0, 1.0).acos() / (TAU / 2.0)]
}

/// A point of [0, 1)^2 to the weights of a triangle's corners.
pub fn in_triangle([x, y]: [f64; 2]) -> [f64; 3] {
    let root = x.sqrt();
    [1.0 - root, root * (1.0 - y), root * y]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Midpoints of a fine grid: sums over them are integrals over the shape.
    const STEPS: usize = 64;

    fn grid() -> impl Iterator<Item = f64> {
        (0..STEPS).map(|index| (index as f64 + 0.5) / STEPS as f64)
    }

    #[test]
    fn the_disc_has_the_moments_of_a_disc() {
        let points: Vec<DVec2> = grid().flat_map(|x| grid().map(move |y| in_disc([x, y]))).collect();
        let mean = |f: &dyn Fn(&DVec2) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
        assert!(points.iter().all(|p| p.length() <= 1.0));
        assert!((mean(&|p| p.x * p.x) - 0.25).abs() < 1e-3 && (mean(&|p| p.y * p.y) - 0.25).abs() < 1e-3);
        assert!((mean(&|p| p.length_squared().powi(2)) - 1.0 / 3.0).abs() < 1e-3);
        assert!(mean(&|p| p.x * p.y).abs() < 1e-9);
        // Centre, middle of an edge, corner.
        assert_eq!(in_disc([0.5, 0.5]), DVec2::ZERO);
        assert!((in_disc([0.0, 0.0]) - dvec2(-0.5f64.sqrt(), -0.5f64.sqrt())).length() < 1e-15);
    }

    #[test]
    fn the_ball_has_the_moments_of_a_ball() {
        let points: Vec<DVec3> =
            grid().flat_map(|x| grid().flat_map(move |y| grid().map(move |z| in_ball([x, y, z])))).collect();
        let mean = |f: &dyn Fn(&DVec3) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
        assert!(points.iter().all(|p| p.length() <= 1.0 + 1e-15));
        for axis in 0..3 {
            assert!((mean(&|p| p[axis] * p[axis]) - 0.2).abs() < 1e-3, "axis {axis}");
            assert!(mean(&|p| p[axis]).abs() < 1e-9, "axis {axis}");
        }
    }

    #[test]
    fn a_triangle_has_its_centroid() {
        let points: Vec<[f64; 3]> = grid().flat_map(|x| grid().map(move |y| in_triangle([x, y]))).collect();
        for corner in 0..3 {
            let mean = points.iter().map(|weights| weights[corner]).sum::<f64>() / points.len() as f64;
            assert!((mean - 1.0 / 3.0).abs() < 2e-4, "{mean}");
        }
    }

    #[test]
    fn a_globe_is_unrolled() {
        assert_eq!(longitude_latitude(DVec3::Z), [0.5, 0.5]);
        assert_eq!(longitude_latitude(DVec3::X), [0.75, 0.5]);
        assert_eq!(longitude_latitude(DVec3::Y)[1], 0.0);
        assert_eq!(longitude_latitude(-DVec3::Y)[1], 1.0);
    }
}
