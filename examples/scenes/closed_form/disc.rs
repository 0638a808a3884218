//! Areas of a disc that other shapes cover.

use super::polygon::edges;
use glam::DVec2;

/// Area of the part of a polygon, corners counter-clockwise, that lies in the disc of radius 1 around the origin: each edge and the
/// origin span a triangle, whose part in the disc is triangles and sectors.
pub fn area_in_unit_disc(polygon: &[DVec2]) -> f64 {
    edges(polygon).map(|(a, b)| under_edge(a, b)).sum()
}

/// Signed area of the triangle of the origin and an edge that lies in the disc.
fn under_edge(a: DVec2, b: DVec2) -> f64 {
    let triangle = |p: DVec2, q: DVec2| p.perp_dot(q) / 2.0;
    let sector = |p: DVec2, q: DVec2| p.perp_dot(q).atan2(p.dot(q)) / 2.0;
    // Where a + t (b - a) has length 1.
    let along = b - a;
    let (square, half, rest) = (along.length_squared(), a.dot(along), a.length_squared() - 1.0);
    let under_root = half * half - square * rest;
    if square == 0.0 || under_root <= 0.0 {
        return sector(a, b);
    }
    let root = under_root.sqrt();
    let (enter, leave) = (((-half - root) / square).max(0.0), ((-half + root) / square).min(1.0));
    if enter >= leave {
        return sector(a, b);
    }
    let (first, last) = (a + enter * along, a + leave * along);
    sector(a, first) + triangle(first, last) + sector(last, b)
}

/// Area that two discs have in common, their centres `distance` apart: two circular segments.
pub fn lens([first, second]: [f64; 2], distance: f64) -> f64 {
    use std::f64::consts::PI;
    if distance >= first + second {
        return 0.0;
    }
    if distance <= (first - second).abs() {
        return PI * first.min(second).powi(2);
    }
    // From a disc's centre to the common chord, and the segment beyond it.
    let segment = |radius: f64, other: f64| {
        let to_chord = (distance * distance + radius * radius - other * other) / (2.0 * distance);
        let angle = (to_chord / radius).clamp(-1.0, 1.0).acos();
        radius * radius * (angle - angle.sin() * angle.cos())
    };
    segment(first, second) + segment(second, first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;
    use std::f64::consts::{PI, TAU};

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12, "{found} not {expected}");
    }

    /// A regular polygon of the same area as the disc.
    fn round(centre: DVec2, radius: f64, corners: usize) -> Vec<DVec2> {
        let angle = TAU / corners as f64;
        let scale = (angle / angle.sin()).sqrt() * radius;
        (0..corners).map(|k| centre + scale * DVec2::from_angle(k as f64 * angle)).collect()
    }

    #[test]
    fn squares_and_halves_of_the_disc_are_counted_by_hand() {
        let square = |low: DVec2, high: DVec2| [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)];
        close(area_in_unit_disc(&square(dvec2(-2.0, -2.0), dvec2(2.0, 2.0))), PI);
        close(area_in_unit_disc(&square(dvec2(0.0, -2.0), dvec2(2.0, 2.0))), PI / 2.0);
        close(area_in_unit_disc(&square(dvec2(0.0, 0.0), dvec2(2.0, 2.0))), PI / 4.0);
        close(area_in_unit_disc(&square(dvec2(-0.5, -0.5), dvec2(0.5, 0.5))), 1.0);
        close(area_in_unit_disc(&square(dvec2(1.0, 1.0), dvec2(2.0, 2.0))), 0.0);
        // The segment beyond x = 1/2.
        close(area_in_unit_disc(&square(dvec2(0.5, -2.0), dvec2(2.0, 2.0))), PI / 3.0 - 0.75f64.sqrt() / 2.0);
        close(area_in_unit_disc(&[]), 0.0);
    }

    #[test]
    fn lenses_are_what_polygons_of_many_corners_cover() {
        close(lens([1.0, 0.5], 0.2), PI / 4.0);
        close(lens([1.0, 0.5], 1.5), 0.0);
        // Equal discs one radius apart.
        close(lens([1.0, 1.0], 1.0), TAU / 3.0 - 0.75f64.sqrt());
        for (radius, distance) in [(0.5, 0.8), (1.5, 0.7), (2.0, 2.5), (0.3, 0.0)] {
            let covered = area_in_unit_disc(&round(dvec2(0.6, -0.8) * distance, radius, 4096));
            assert!((covered - lens([1.0, radius], distance)).abs() < 1e-5, "{radius} {distance}: {covered}");
        }
    }
}
