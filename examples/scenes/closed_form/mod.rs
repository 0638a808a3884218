//! Soft shadows whose answer is known without samples: convex casters in front of a flat light.
//!
//! Seen from a receiver, a convex caster covers the convex hull of its vertices, projected from the receiver to the light's plane.
//! The blocked share of a rectangle or disc is the area that the hulls cover of it, exactly: hulls are cut by Sutherland and
//! Hodgman's algorithm, their parts in a disc are triangles and sectors, and several casters fuse by inclusion and exclusion
//! (apart: the sum; nested: the larger; half and other half: all). A half-plane over a square light gives the linear ramp, a disc
//! over a disc the lens of two circles.
//!
//! Coordinates in the light's plane are in units of its half axes: the rectangle is the square from -1 to 1, the disc has radius 1;
//! shares of area are the same there. All numbers are f64.
//!
//! Valid where every caster lies strictly between the receiver and the light's plane.

mod disc;
mod polygon;
#[cfg(test)]
mod tests;

pub use disc::{area_in_unit_disc, lens};
pub use polygon::{area, common, hull};

use crate::builtin;
use glam::{DVec2, DVec3, Vec3};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::{Light, LightShape};

/// A flat light's outline in its own plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outline {
    /// From -1 to 1 along both half axes.
    Rectangle,
    /// Within 1 of the centre.
    Disc,
}

/// Casters and a light, world space.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedForm {
    /// Centre of the light.
    pub centre: DVec3,
    /// From there to its edge; perpendicular, of equal length for a disc.
    pub half_axes: [DVec3; 2],
    /// What of its plane shines.
    pub outline: Outline,
    /// Vertices of each convex caster, in any order.
    pub casters: Vec<Vec<DVec3>>,
}

/// The closed form of `NAME?param=value&..`, a built-in scene; none if the scene has none.
///
/// # Errors
/// No such scene, or a wrong parameter.
pub fn of_builtin(text: &str) -> Result<Option<ClosedForm>, Problem> {
    let Some(known) = builtin::known(text)? else { return Ok(None) };
    Ok(ClosedForm::new(&known.light, &known.casters))
}

impl ClosedForm {
    /// Of a rectangle or disc; none for other lights.
    pub fn new(light: &Light, casters: &[Vec<Vec3>]) -> Option<Self> {
        let (outline, half_axes) = match &light.shape {
            LightShape::Rectangle { half_axes } => (Outline::Rectangle, half_axes),
            LightShape::Disc { half_axes } => (Outline::Disc, half_axes),
            _ => return None,
        };
        let wide = |v: [f32; 3]| Vec3::from(v).as_dvec3();
        let casters = casters.iter().map(|vertices| vertices.iter().map(|v| v.as_dvec3()).collect()).collect();
        Some(Self { centre: wide(light.position), half_axes: half_axes.map(wide), outline, casters })
    }

    /// The visible share of the light at `receiver`, 0..=1.
    pub fn visible(&self, receiver: DVec3) -> f64 {
        let hulls: Vec<Vec<DVec2>> =
            self.casters.iter().map(|vertices| self.hull_seen_from(receiver, vertices)).collect();
        let everywhere = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DVec2::new(1.0, 1.0), DVec2::new(-1.0, 1.0)];
        1.0 - self.covered(&everywhere, &hulls) / self.area(&everywhere)
    }

    /// Area of the part of the light within `window` that at least one hull covers.
    fn covered(&self, window: &[DVec2], hulls: &[Vec<DVec2>]) -> f64 {
        let Some((first, rest)) = hulls.split_first() else { return 0.0 };
        let part = common(window, first);
        // |A or B| = |A| + |B| - |A and B|, B being the union of the rest.
        self.area(&part) + self.covered(window, rest) - self.covered(&part, rest)
    }

    fn area(&self, polygon: &[DVec2]) -> f64 {
        match self.outline {
            Outline::Rectangle => area(polygon),
            Outline::Disc => area_in_unit_disc(polygon),
        }
    }

    /// What a caster covers of the light's plane.
    pub fn hull_seen_from(&self, receiver: DVec3, vertices: &[DVec3]) -> Vec<DVec2> {
        let normal = self.half_axes[0].cross(self.half_axes[1]);
        let project = |vertex: &DVec3| {
            let along = *vertex - receiver;
            let on_plane = receiver + along * (normal.dot(self.centre - receiver) / normal.dot(along));
            self.in_half_axes(on_plane - self.centre)
        };
        hull(&vertices.iter().map(project).collect::<Vec<_>>())
    }

    /// Factors of the half axes, which may be oblique.
    fn in_half_axes(&self, offset: DVec3) -> DVec2 {
        let [u, v] = self.half_axes;
        let normal = u.cross(v);
        let scale = normal.length_squared();
        DVec2::new(offset.cross(v).dot(normal), u.cross(offset).dot(normal)) / scale
    }
}
