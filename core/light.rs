//! Lights as plain data: where a light is, how far it reaches, what it looks like.
//!
//! Invariants that the functions here keep: `position` is the centre and `radius` bounds every point of the light from there; a
//! hard shadow's one light sample is `position`. A light may have no extent (`radius` 0), an area or a volume.

use glam::{DVec3, Vec3};
use std::sync::Arc;

/// A light, world space. Make one with the functions below, which keep `position`, `radius` and `shape` in agreement.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name for records.
    pub name: String,
    /// Its centre; a hard shadow's one light sample.
    pub position: [f32; 3],
    /// Every point of the light is at most so far from `position`; 0 for a point. The radius itself of a sphere.
    pub radius: f32,
    /// Linear RGB.
    pub color: [f32; 3],
    /// Which points shine.
    pub shape: LightShape,
    /// What the shape's surface shows, times `color`; none: uniform. Only shapes with (u, v) take one.
    pub texture: Option<Arc<Texture>>,
}

/// Which points shine, all of them alike but for the texture. Axes are offsets from the light's position to its edge, scene
/// units; they need not be perpendicular (a rectangle is then a parallelogram).
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LightShape {
    /// The position alone.
    #[default]
    Point,
    /// The solid ball of the light's radius, uniform by volume. (u, v): longitude around y, latitude from the top.
    Sphere,
    /// A flat ellipse, a disc where the axes are perpendicular and of equal length. (u, v) as of its bounding rectangle.
    Disc {
        /// From the centre to the rim.
        half_axes: [[f32; 3]; 2],
    },
    /// A flat rectangle. u grows along the first axis, the image's top is at the end of the second.
    Rectangle {
        /// From the centre to the middles of two sides.
        half_axes: [[f32; 3]; 2],
    },
    /// A solid ellipsoid, uniform by volume. (u, v) as of a sphere, in its own axes.
    Ellipsoid {
        /// From the centre to its surface.
        half_axes: [[f32; 3]; 3],
    },
    /// Separate points, world space.
    Points {
        /// Where they are.
        positions: Arc<Vec<[f32; 3]>>,
        /// Linear RGB of each, times the light's colour; empty: all white.
        colors: Arc<Vec<[f32; 3]>>,
    },
    /// The surface of triangles, world space, uniform by area.
    Surface(Arc<Vec<[[f32; 3]; 3]>>),
    /// The inside of closed meshes, world space, uniform by volume.
    Volume(Arc<Vec<[[f32; 3]; 3]>>),
    /// Several lights as one, each with its own colour and texture; they shine alike per area or volume.
    Parts(Vec<Light>),
}

/// A picture on a light: linear RGB, row-major from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Columns, at least one.
    pub width: usize,
    /// Rows, at least one.
    pub height: usize,
    /// `width * height` texels, finite, none negative.
    pub texels: Vec<[f32; 3]>,
}

impl LightShape {
    /// Its name on the command line, in views files and in records.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Sphere => "sphere",
            Self::Disc { .. } => "disc",
            Self::Rectangle { .. } => "rectangle",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Points { .. } => "points",
            Self::Surface(_) => "surface",
            Self::Volume(_) => "volume",
            Self::Parts(_) => "parts",
        }
    }
}

impl Light {
    /// White, without extent.
    pub fn point(name: impl Into<String>, position: [f32; 3]) -> Self {
        let (name, shape) = (name.into(), LightShape::Point);
        Self { name, position, radius: 0.0, color: [1.0; 3], shape, texture: None }
    }

    /// A white ball; a point where the radius is 0.
    pub fn sphere(name: impl Into<String>, position: [f32; 3], radius: f32) -> Self {
        let shape = if radius > 0.0 { LightShape::Sphere } else { LightShape::Point };
        Self { radius, shape, ..Self::point(name, position) }
    }

    /// A white light whose radius follows from its shape: a disc, rectangle or ellipsoid around `position`. Points, meshes and
    /// parts have a place of their own; `position` is then their centre. A sphere has a radius: see [`Light::sphere`].
    pub fn shaped(name: impl Into<String>, position: [f32; 3], shape: LightShape) -> Self {
        let radius = bounding_radius(position, &shape);
        Self { radius, shape, ..Self::point(name, position) }
    }

    /// A white rectangle, or any parallelogram, by its corners in order around it; the fourth follows from the first three.
    pub fn rectangle(name: impl Into<String>, corners: [[f32; 3]; 4]) -> Self {
        let [a, b, c, _] = corners.map(|corner| Vec3::from(corner).as_dvec3());
        let narrow = |v: DVec3| v.as_vec3().to_array();
        let half_axes = [narrow((b - a) / 2.0), narrow((c - b) / 2.0)];
        Self::shaped(name, narrow((a + c) / 2.0), LightShape::Rectangle { half_axes })
    }

    /// The same light with another colour.
    pub fn colored(mut self, color: [f32; 3]) -> Self {
        self.color = color;
        self
    }

    /// The same light with a texture on it.
    pub fn textured(mut self, texture: Texture) -> Self {
        self.texture = Some(Arc::new(texture));
        self
    }

    /// The same light around another centre; every point of it moves along.
    pub fn moved_to(self, position: [f32; 3]) -> Self {
        let by = wide(position) - wide(self.position);
        let from = self.position;
        self.mapped(position, &|point| if position == from { point } else { narrow(wide(point) + by) }, 1.0)
    }

    /// The same light, made larger or smaller around its centre until `radius` bounds it. A point becomes a sphere.
    pub fn with_radius(mut self, radius: f32) -> Self {
        if matches!(self.shape, LightShape::Point | LightShape::Sphere) || self.radius == 0.0 {
            self.shape = if radius > 0.0 { LightShape::Sphere } else { LightShape::Point };
            self.radius = radius;
            return self;
        }
        let (centre, factor) = (wide(self.position), f64::from(radius) / f64::from(self.radius));
        let position = self.position;
        self.mapped(position, &|point| narrow(centre + factor * (wide(point) - centre)), factor)
    }

    /// Every point of the light through `place`, which scales by `factor`.
    fn mapped(mut self, position: [f32; 3], place: &dyn Fn([f32; 3]) -> [f32; 3], factor: f64) -> Self {
        let scaled = |axis: [f32; 3]| narrow(factor * wide(axis));
        let triangles =
            |rows: Arc<Vec<[[f32; 3]; 3]>>| Arc::new(rows.iter().map(|corners| corners.map(place)).collect());
        self.shape = match self.shape {
            LightShape::Disc { half_axes } => LightShape::Disc { half_axes: half_axes.map(scaled) },
            LightShape::Rectangle { half_axes } => LightShape::Rectangle { half_axes: half_axes.map(scaled) },
            LightShape::Ellipsoid { half_axes } => LightShape::Ellipsoid { half_axes: half_axes.map(scaled) },
            LightShape::Points { positions, colors } => {
                LightShape::Points { positions: Arc::new(positions.iter().copied().map(place).collect()), colors }
            }
            LightShape::Surface(rows) => LightShape::Surface(triangles(rows)),
            LightShape::Volume(rows) => LightShape::Volume(triangles(rows)),
            LightShape::Parts(parts) => {
                let moved = |part: Light| {
                    let position = place(part.position);
                    part.mapped(position, place, factor)
                };
                LightShape::Parts(parts.into_iter().map(moved).collect())
            }
            shape @ (LightShape::Point | LightShape::Sphere) => shape,
        };
        self.position = position;
        self.radius = match self.shape {
            LightShape::Point | LightShape::Sphere => (f64::from(self.radius) * factor) as f32,
            _ => bounding_radius(position, &self.shape),
        };
        self
    }
}

fn wide(point: [f32; 3]) -> DVec3 {
    Vec3::from(point).as_dvec3()
}

fn narrow(point: DVec3) -> [f32; 3] {
    point.as_vec3().to_array()
}

/// Distance from `centre` to the furthest point of a shape, never below it; 0 for a sphere, which does not know its radius.
fn bounding_radius(centre: [f32; 3], shape: &LightShape) -> f32 {
    let from_centre = |point: &[f32; 3]| (wide(*point) - wide(centre)).length();
    let furthest = |points: &mut dyn Iterator<Item = &[f32; 3]>| points.map(from_centre).fold(0.0, f64::max);
    let radius = match shape {
        LightShape::Point | LightShape::Sphere => 0.0,
        LightShape::Disc { half_axes } => largest_stretch(half_axes),
        LightShape::Ellipsoid { half_axes } => largest_stretch(half_axes),
        LightShape::Rectangle { half_axes: [u, v] } => {
            let (u, v) = (wide(*u), wide(*v));
            (u + v).length().max((u - v).length())
        }
        LightShape::Points { positions, .. } => furthest(&mut positions.iter()),
        LightShape::Surface(triangles) | LightShape::Volume(triangles) => furthest(&mut triangles.iter().flatten()),
        LightShape::Parts(parts) => {
            let reach = |part: &Light| from_centre(&part.position) + f64::from(part.radius);
            parts.iter().map(reach).fold(0.0, f64::max)
        }
    };
    let rounded = radius as f32;
    if f64::from(rounded) < radius { rounded.next_up() } else { rounded }
}

/// A bound of how far a sum of the axes reaches whose squared factors sum to one: the longest axis where they are perpendicular.
fn largest_stretch(axes: &[[f32; 3]]) -> f64 {
    let longest = axes.iter().map(|axis| wide(*axis).length()).fold(0.0, f64::max);
    let dot = |a: usize, b: usize| wide(axes[a]).dot(wide(axes[b])).abs();
    // Gershgorin's bound on the largest eigenvalue of the axes' products.
    let row = |a: usize| (0..axes.len()).map(|b| dot(a, b)).sum::<f64>();
    let bound = (0..axes.len()).map(row).fold(0.0, f64::max).sqrt();
    // Perpendicular up to the rounding of the axes themselves: no wider than the longest.
    if bound <= longest * (1.0 + 1e-6) { longest } else { bound }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_bound_the_shapes() {
        let disc = Light::shaped("", [1.0; 3], LightShape::Disc { half_axes: [[2.0, 0.0, 0.0], [0.0, 0.0, 2.0]] });
        assert_eq!(disc.radius, 2.0);
        let corners = [[-3.0, 5.0, -4.0], [3.0, 5.0, -4.0], [3.0, 5.0, 4.0], [-3.0, 5.0, 4.0]];
        let rectangle = Light::rectangle("", corners);
        assert_eq!((rectangle.position, rectangle.radius), ([0.0, 5.0, 0.0], 5.0));
        assert_eq!(rectangle.shape, LightShape::Rectangle { half_axes: [[3.0, 0.0, 0.0], [0.0, 0.0, 4.0]] });
        let axes = [[1.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 0.2]];
        assert_eq!(Light::shaped("", [0.0; 3], LightShape::Ellipsoid { half_axes: axes }).radius, 4.0);
        let sheared = LightShape::Disc { half_axes: [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]] };
        assert!(Light::shaped("", [0.0; 3], sheared).radius >= 2.0f32.sqrt());
    }

    #[test]
    fn moving_and_growing_keep_shape_centre_and_radius_together() {
        let ball = |x| Light::sphere("", [x, 0.0, 0.0], 0.5);
        let light = Light::shaped("", [0.0; 3], LightShape::Parts(vec![ball(-1.0), ball(1.0)]));
        assert_eq!(light.radius, 1.5);
        let light = light.moved_to([0.0, 2.0, 0.0]).with_radius(3.0);
        let LightShape::Parts(parts) = &light.shape else { panic!("{light:?}") };
        assert_eq!((parts[0].position, parts[0].radius), ([-2.0, 2.0, 0.0], 1.0));
        assert_eq!(light.radius, 3.0);
        assert_eq!(Light::point("", [1.0; 3]).with_radius(2.0), Light::sphere("", [1.0; 3], 2.0));
        assert_eq!(Light::sphere("", [1.0; 3], 0.0), Light::point("", [1.0; 3]));
        let points = LightShape::Points { positions: Arc::new(vec![[0.1, 0.2, 0.3]; 2]), colors: Arc::default() };
        let light = Light::shaped("", [0.1, 0.2, 0.3], points.clone());
        assert_eq!(light.clone().moved_to([0.1, 0.2, 0.3]).shape, points, "not moving keeps every bit");
    }
}
