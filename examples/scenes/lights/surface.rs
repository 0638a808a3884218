//! Points on triangles, uniform by area.
//!
//! One coordinate of the unit square chooses the triangle by its share of the area and is stretched again to [0, 1) inside of it, so
//! that what is well spread in the square stays spread over the mesh.

use super::shapes;
use glam::{DVec3, Vec3};

/// Triangles with the sum of the areas up to each.
pub struct Surface {
    corners: Vec<[DVec3; 3]>,
    area_up_to: Vec<f64>,
}

impl Surface {
    /// Triangles without area are never chosen.
    pub fn new(triangles: &[[[f32; 3]; 3]]) -> Self {
        let corners: Vec<[DVec3; 3]> = triangles.iter().map(|corners| corners.map(wide)).collect();
        let mut total = 0.0;
        let area_up_to = corners.iter().map(|corners| {
            total += area(corners);
            total
        });
        let area_up_to = area_up_to.collect();
        Self { corners, area_up_to }
    }

    /// Area of all, square scene units.
    pub fn area(&self) -> f64 {
        self.area_up_to.last().copied().unwrap_or(0.0)
    }

    /// The mean of all points.
    pub fn centroid(&self) -> DVec3 {
        let weighted = |corners: &[DVec3; 3]| area(corners) * (corners[0] + corners[1] + corners[2]) / 3.0;
        self.corners.iter().map(weighted).sum::<DVec3>() / self.area()
    }

    /// The point of a point in the unit square. There must be an area.
    pub fn point(&self, [x, y]: [f64; 2]) -> DVec3 {
        let at = x * self.area();
        let triangle = self.area_up_to.partition_point(|up_to| *up_to <= at).min(self.corners.len() - 1);
        let start = if triangle == 0 { 0.0 } else { self.area_up_to[triangle - 1] };
        let share = ((at - start) / (self.area_up_to[triangle] - start)).clamp(0.0, 1.0);
        let weights = shapes::in_triangle([if share.is_nan() { 0.5 } else { share }, y]);
        weights.iter().zip(self.corners[triangle]).map(|(weight, corner)| *weight * corner).sum()
    }
}

fn area([a, b, c]: &[DVec3; 3]) -> f64 {
    (*b - *a).cross(*c - *a).length() / 2.0
}

fn wide(point: [f32; 3]) -> DVec3 {
    Vec3::from(point).as_dvec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Areas 1, 0 and 3.
    const TRIANGLES: [[[f32; 3]; 3]; 3] = [
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [7.0, 0.0, 0.0]],
        [[0.0, 0.0, 9.0], [3.0, 0.0, 9.0], [0.0, 2.0, 9.0]],
    ];

    #[test]
    fn triangles_are_chosen_by_area() {
        let surface = Surface::new(&TRIANGLES);
        assert_eq!(surface.area(), 4.0);
        let heights: Vec<f64> = (0..8).map(|index| surface.point([(index as f64 + 0.5) / 8.0, 0.5]).z).collect();
        assert_eq!(heights, [0.0, 0.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0]);
        assert_eq!(surface.centroid().z, 6.75);
    }
}
