//! A scene as plain data: triangles in world space, what is known of them, cameras and lights.

pub use crate::light::{Light, LightShape, Texture};

/// Flag bits of a triangle.
pub mod flag {
    /// Part of a closed two-manifold with consistent winding: light-back-facing triangles alone decide its shadows.
    pub const CLOSED: u32 = 1;
    /// glTF alphaMode MASK; cast as opaque until transparency is built.
    pub const ALPHA_MASK: u32 = 2;
    /// glTF alphaMode BLEND; cast as opaque until transparency is built.
    pub const ALPHA_BLEND: u32 = 4;
    /// glTF doubleSided.
    pub const TWO_SIDED: u32 = 8;
}

/// Triangles and what is known of them. All `Vec`s of one row a triangle have equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Name for records.
    pub name: String,
    /// Corners in world space; counter-clockwise seen from outside. Every number is finite.
    pub positions: Vec<[[f32; 3]; 3]>,
    /// Unit shading normal at each corner, world space.
    pub normals: Vec<[[f32; 3]; 3]>,
    /// Bits of [`flag`].
    pub flags: Vec<u32>,
    /// Linear RGB reflectance, 0..=1.
    pub albedo: Vec<[f32; 3]>,
    /// Smooth vertex at each corner: equal position and equal shading normal. Below `face_offset.len() - 1`.
    pub corner_vertex: Vec<[u32; 3]>,
    /// Start of each smooth vertex's faces in `faces`; one more entry than vertices.
    pub face_offset: Vec<u32>,
    /// Triangles around each smooth vertex, ascending.
    pub faces: Vec<u32>,
    /// Number of connected parts, and how many of them are closed.
    pub parts_count: usize,
    /// Closed parts.
    pub closed_parts_count: usize,
    /// Cameras found in the file.
    pub cameras: Vec<Camera>,
    /// Lights found in the file.
    pub lights: Vec<Light>,
    /// What was dropped or taken differently, one sentence each, with counts: shown in every run's record.
    pub notes: Vec<String>,
}

/// A pinhole camera, world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name for records.
    pub name: String,
    /// Centre of projection.
    pub eye: [f32; 3],
    /// Looked-at point; differs from `eye`.
    pub target: [f32; 3],
    /// Up, not parallel to the view direction.
    pub up: [f32; 3],
    /// Full vertical angle, radians, in (0, pi).
    pub fov_y: f32,
}

impl Scene {
    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.positions.len()
    }
    /// Smallest and largest corner coordinates; none for an empty scene.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let mut corners = self.positions.iter().flatten();
        let first = *corners.next()?;
        Some(corners.fold([first, first], |[mut low, mut high], corner| {
            for axis in 0..3 {
                low[axis] = low[axis].min(corner[axis]);
                high[axis] = high[axis].max(corner[axis]);
            }
            [low, high]
        }))
    }
}
