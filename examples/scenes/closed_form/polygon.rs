//! Convex polygons in the plane: hull, common part, area. Corners run counter-clockwise.

use glam::DVec2;

/// Twice the signed area of the triangle a, b, c: positive where it turns counter-clockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The convex hull of points (Andrew's monotone chain); what is left of fewer than three is returned as it is.
pub fn hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && turn(a, b, point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        // The other chain starts where this one ends.
        chain.pop();
        chain
    };
    let mut corners = chain(&mut sorted.iter().copied());
    corners.extend(chain(&mut sorted.iter().rev().copied()));
    corners
}

/// The common part of two convex polygons (Sutherland, Hodgman 1974): `subject` cut along every edge of `clip`.
pub fn common(subject: &[DVec2], clip: &[DVec2]) -> Vec<DVec2> {
    let mut left = subject.to_vec();
    for (from, to) in edges(clip) {
        let mut next = Vec::with_capacity(left.len() + 1);
        for (a, b) in edges(&left) {
            let (at_a, at_b) = (turn(from, to, a), turn(from, to, b));
            if at_a >= 0.0 {
                next.push(a);
            }
            if (at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0) {
                next.push(a + (b - a) * (at_a / (at_a - at_b)));
            }
        }
        left = next;
    }
    left
}

/// Area; 0 with fewer than three corners.
pub fn area(polygon: &[DVec2]) -> f64 {
    edges(polygon).map(|(a, b)| a.perp_dot(b)).sum::<f64>() / 2.0
}

/// Edges in order.
pub fn edges(polygon: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn square(low: DVec2, side: f64) -> Vec<DVec2> {
        [dvec2(0.0, 0.0), dvec2(side, 0.0), dvec2(side, side), dvec2(0.0, side)].map(|corner| low + corner).to_vec()
    }

    #[test]
    fn a_hull_has_neither_inner_points_nor_points_on_its_edges() {
        let mut points = square(dvec2(1.0, 2.0), 2.0);
        points.extend([dvec2(2.0, 3.0), dvec2(2.0, 2.0), dvec2(1.0, 2.0)]);
        let found = hull(&points);
        assert_eq!((found.len(), area(&found)), (4, 4.0));
        assert_eq!(hull(&[dvec2(1.0, 1.0), dvec2(1.0, 1.0)]).len(), 1);
        assert_eq!(area(&hull(&[dvec2(0.0, 0.0), dvec2(1.0, 1.0), dvec2(2.0, 2.0)])), 0.0);
    }

    #[test]
    fn common_parts_are_counted_by_hand() {
        let unit = square(dvec2(0.0, 0.0), 1.0);
        let with = |other: &[DVec2]| area(&common(&unit, other));
        assert_eq!(with(&square(dvec2(0.5, 0.25), 1.0)), 0.375);
        assert_eq!(with(&square(dvec2(-1.0, -1.0), 3.0)), 1.0, "inside");
        assert_eq!(with(&square(dvec2(0.25, 0.25), 0.5)), 0.25, "around");
        assert_eq!(with(&square(dvec2(1.0, 0.0), 1.0)), 0.0, "touching");
        assert_eq!(with(&square(dvec2(5.0, 0.0), 1.0)), 0.0, "apart");
        assert_eq!(with(&hull(&[dvec2(0.0, 0.0), dvec2(2.0, 0.0), dvec2(0.0, 2.0)])), 1.0);
        assert_eq!(with(&hull(&[dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(0.0, 1.0)])), 0.5);
    }
}
