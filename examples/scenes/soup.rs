//! Triangles on their way to a [`Scene`]: the builder that loaders and built-in scenes share.

use crate::topology;
use glam::{DVec3, Vec3};
use shadowgraph_core::scene::{Camera, Light, Scene};

/// What a triangle looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Linear RGB reflectance, 0..=1.
    pub albedo: [f32; 3],
    /// Bits of [`shadowgraph_core::scene::flag`], without `CLOSED`, which is found later.
    pub flags: u32,
}

impl Look {
    /// An opaque one-sided look.
    pub const fn new(red: f32, green: f32, blue: f32) -> Self {
        Self { albedo: [red, green, blue], flags: 0 }
    }
    /// The same with more flag bits.
    pub const fn with(self, flags: u32) -> Self {
        Self { albedo: self.albedo, flags: self.flags | flags }
    }
}

/// Triangles in world space, one row each, with the shape that they belong to.
#[derive(Clone, Debug, Default)]
pub struct Soup {
    /// Corners, counter-clockwise seen from outside.
    pub positions: Vec<[[f32; 3]; 3]>,
    /// Unit shading normals at the corners.
    pub normals: Vec<[[f32; 3]; 3]>,
    /// Looks.
    pub looks: Vec<Look>,
    /// The mesh instance of each triangle: positions are welded within one first.
    pub shapes: Vec<u32>,
    /// Cameras.
    pub cameras: Vec<Camera>,
    /// Lights.
    pub lights: Vec<Light>,
    /// Sentences for the record.
    pub notes: Vec<String>,
    shape: u32,
}

impl Soup {
    /// Starts another mesh instance: triangles pushed from here on belong to it.
    pub fn start_shape(&mut self) {
        self.shape += 1;
    }

    /// One triangle with its geometric normal at all corners.
    pub fn flat(&mut self, corners: [Vec3; 3], look: Look) {
        let normal = geometric_normal(corners.map(|corner| corner.to_array()));
        self.smooth(corners, [Vec3::from(normal); 3], look);
    }

    /// One triangle with given unit normals.
    pub fn smooth(&mut self, corners: [Vec3; 3], normals: [Vec3; 3], look: Look) {
        self.positions.push(corners.map(|corner| corner.to_array()));
        self.normals.push(normals.map(|normal| normal.to_array()));
        self.looks.push(look);
        self.shapes.push(self.shape);
    }

    /// The scene, with its topology found and zero-area triangles counted.
    pub fn finish(mut self, name: &str) -> Scene {
        let zero_area = self.positions.iter().filter(|corners| area_vector(corners) == DVec3::ZERO).count();
        if zero_area > 0 {
            self.notes.push(format!("{zero_area} triangles have no area: kept, they never block light"));
        }
        let parts = topology::find_parts(&self.positions, &self.shapes);
        let smooth = topology::smooth_vertices(&self.positions, &self.normals, &self.shapes);
        Scene {
            name: name.into(),
            flags: self.looks.iter().zip(&parts.closed_flag).map(|(look, closed)| look.flags | closed).collect(),
            albedo: self.looks.iter().map(|look| look.albedo).collect(),
            positions: self.positions,
            normals: self.normals,
            corner_vertex: smooth.corner_vertex,
            face_offset: smooth.face_offset,
            faces: smooth.faces,
            parts_count: parts.parts_count,
            closed_parts_count: parts.closed_count,
            cameras: self.cameras,
            lights: self.lights,
            notes: self.notes,
        }
    }
}

/// Cross product of two edges in f64: twice the area, along the normal; zero where the area is.
pub fn area_vector(corners: &[[f32; 3]; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| Vec3::from(corner).as_dvec3());
    (b - a).cross(c - a)
}

/// Unit geometric normal, rounded once from f64; +y where a triangle has no area.
pub fn geometric_normal(corners: [[f32; 3]; 3]) -> [f32; 3] {
    area_vector(&corners).normalize_or(DVec3::Y).as_vec3().to_array()
}
