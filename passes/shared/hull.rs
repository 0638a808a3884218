//! The convex hull of a few convex polygons in linear time (Sintorn 2008, section 4.1, after Graham 1972).
//!
//! Points of a convex polygon come in angular order, so from its leftmost point two chains run to the right, each sorted by
//! x. Merging all chains sorts all points in linear time, and a scan over sorted points that drops every turn to the right, once
//! there and once back, leaves the hull. Polygons need no common centre.
//!
//! Rounding may spoil the order of points that nearly coincide; then a corner of the result may be missing or superfluous. Whoever
//! needs a bound measures each side against all points, as [`crate::shared::influence`] does.

/// Sides of a polygon, at most.
pub const MOST_SIDES: usize = 8;
/// Points of three polygons, at most.
pub const MOST_POINTS: usize = 3 * MOST_SIDES;
/// Places of a hull: rounding may leave a point on both of its chains.
pub const HULL_ROOM: usize = 2 * MOST_POINTS;

/// A point of the plane.
pub type Point = [f64; 2];

/// Whether `a` is left of `b`, or below it.
fn is_before(a: Point, b: Point) -> bool {
    a[0] < b[0] || (a[0] == b[0] && a[1] < b[1])
}

/// Twice the area of the triangle, above zero for a turn to the left.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The points of a convex polygon from left to right.
fn sorted(polygon: &[Point], into: &mut [Point]) {
    let count = polygon.len();
    let mut first = 0;
    for k in 1..count {
        if is_before(polygon[k], polygon[first]) {
            first = k;
        }
    }
    into[0] = polygon[first];
    let (mut up, mut down) = ((first + 1) % count, (first + count - 1) % count);
    for place in &mut into[1..count] {
        if is_before(polygon[up], polygon[down]) {
            *place = polygon[up];
            up = (up + 1) % count;
        } else {
            *place = polygon[down];
            down = (down + count - 1) % count;
        }
    }
}

/// Two sorted runs into one.
fn merge(a: &[Point], b: &[Point], into: &mut [Point]) {
    let (mut i, mut j) = (0, 0);
    for place in &mut into[..a.len() + b.len()] {
        if j == b.len() || (i < a.len() && is_before(a[i], b[j])) {
            *place = a[i];
            i += 1;
        } else {
            *place = b[j];
            j += 1;
        }
    }
}

/// Corners of the hull of `points`, which are three convex polygons of equally many points one after another, either way
/// round; counter-clockwise from the left, in the first places of `hull`. Their number: the first is not repeated.
pub fn hull_of_three(points: &[Point], hull: &mut [Point; HULL_ROOM]) -> usize {
    let sides = points.len() / 3;
    let mut runs = [[0.0; 2]; MOST_POINTS];
    for k in 0..3 {
        sorted(&points[k * sides..(k + 1) * sides], &mut runs[k * sides..(k + 1) * sides]);
    }
    let mut two = [[0.0; 2]; MOST_POINTS];
    merge(&runs[..sides], &runs[sides..2 * sides], &mut two);
    let mut all = [[0.0; 2]; MOST_POINTS];
    merge(&two[..2 * sides], &runs[2 * sides..3 * sides], &mut all);

    // There along the lower side, back along the upper.
    let mut count = 0;
    for point in &all[..points.len()] {
        while count >= 2 && turn(hull[count - 2], hull[count - 1], *point) <= 0.0 {
            count -= 1;
        }
        hull[count] = *point;
        count += 1;
    }
    let lower = count;
    for point in all[..points.len() - 1].iter().rev() {
        while count > lower && turn(hull[count - 2], hull[count - 1], *point) <= 0.0 {
            count -= 1;
        }
        hull[count] = *point;
        count += 1;
    }
    count - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::hard_scenes::Random;

    fn regular(centre: Point, radius: f64, sides: usize, turned: f64) -> Vec<Point> {
        let angle = |k: usize| turned + k as f64 * std::f64::consts::TAU / sides as f64;
        (0..sides).map(|k| [centre[0] + radius * angle(k).cos(), centre[1] + radius * angle(k).sin()]).collect()
    }

    fn hull(points: &[Point]) -> Vec<Point> {
        let mut corners = [[0.0; 2]; HULL_ROOM];
        let count = hull_of_three(points, &mut corners);
        corners[..count].to_vec()
    }

    #[test]
    fn three_points_and_one_point() {
        assert_eq!(hull(&[[0.0, 0.0], [1.0, 2.0], [1.0, 0.0]]), [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]]);
        let lone = hull(&[[3.0, 4.0]; 12]);
        assert!(!lone.is_empty() && lone.iter().all(|point| *point == [3.0, 4.0]));
    }

    #[test]
    fn three_squares_in_a_row_are_a_rectangle() {
        let square = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
        let points = [square(0.0), square(5.0), square(2.5)].concat();
        assert_eq!(hull(&points), [[0.0, 0.0], [6.0, 0.0], [6.0, 1.0], [0.0, 1.0]]);
    }

    #[test]
    fn random_polygons_lie_inside_and_every_corner_is_needed() {
        let mut random = Random(7);
        for round in 0..2000 {
            let sides = [4, 6, 8][round % 3];
            let mut points = Vec::new();
            for _ in 0..3 {
                let mut next = || f64::from(random.signed());
                let mut polygon = regular([next(), next()], 0.6 * next().abs(), sides, 3.0 * next());
                if next() < 0.0 {
                    polygon.reverse();
                }
                points.extend(polygon);
            }
            let hull = hull(&points);
            assert!(hull.len() >= 3);
            for k in 0..hull.len() {
                let (a, b, c) = (hull[k], hull[(k + 1) % hull.len()], hull[(k + 2) % hull.len()]);
                assert!(turn(a, b, c) > 0.0, "{round}");
                assert!(points.iter().all(|point| turn(a, b, *point) >= -1e-12), "{round}");
            }
        }
    }
}
