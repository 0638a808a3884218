//! What the two camera passes share: which pixels a triangle covers, and the surface point seen through one.
//!
//! A triangle is handled in homogeneous picture coordinates, so one that crosses the eye plane needs no clipping: a pixel sees
//! it where all three of its edge functions agree with the triangle's orientation, and then it lies in front of the eye
//! (Olano and Greer 1997, Triangle Scan Conversion using 2D Homogeneous Coordinates, section 3).

use crate::ports;
use crate::shared::camera::Camera;
use glam::{DVec3, Vec3};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::NO_TRIANGLE;

/// Corners in world space.
pub type Corners = [[f32; 3]; 3];

/// Edge functions of a triangle in the picture.
#[derive(Clone, Copy, Debug)]
pub struct Edges {
    /// Opposite to each corner; times (column, row, 1) not below zero inside, whichever way the triangle faces. Shared edges
    /// of neighbours are the same numbers with opposite signs, so no pixel falls between.
    pub functions: [DVec3; 3],
    /// The sum of the three functions at a pixel times this is 1 / depth there.
    pub inverse_volume: f64,
}

impl Edges {
    /// From homogeneous picture coordinates of the corners. None for a triangle that is degenerate, seen from its edge, or
    /// wholly behind the eye.
    #[inline]
    pub fn new(corners: [DVec3; 3]) -> Option<Self> {
        if corners.iter().all(|corner| corner.z <= 0.0) {
            return None;
        }
        let [a, b, c] = corners;
        let functions = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(functions[0]);
        if !(volume.is_finite() && volume != 0.0) {
            return None;
        }
        let sign = volume.signum();
        Some(Self { functions: functions.map(|function| sign * function), inverse_volume: 1.0 / volume.abs() })
    }

    /// 1 / depth of the triangle at the point (column, row), or none where it is not seen. An edge belongs to the triangle.
    #[inline]
    pub fn nearness(&self, column: f64, row: f64) -> Option<f64> {
        let values = self.functions.map(|edge| edge.x * column + (edge.y * row + edge.z));
        let is_inside = (values[0] >= 0.0) & (values[1] >= 0.0) & (values[2] >= 0.0);
        let sum = values[0] + values[1] + values[2];
        (is_inside & (sum > 0.0)).then_some(sum * self.inverse_volume)
    }
}

/// Where the ray from `eye` along `ray` meets the triangle's plane, and the plane's unit normal on the side of the eye: in f64
/// on the stored corners, rounded once. None where that is not finite.
#[inline]
pub fn seen_point(corners: &Corners, eye: DVec3, ray: DVec3) -> Option<(Vec3, Vec3)> {
    let [a, b, c] = corners.map(|corner| Vec3::from(corner).as_dvec3());
    let normal = (b - a).cross(c - a);
    let along = normal.dot(ray);
    let position = (eye + normal.dot(a - eye) / along * ray).as_vec3();
    let towards_eye = if along > 0.0 { -normal } else { normal };
    let normal = towards_eye.normalize_or_zero().as_vec3();
    (position.is_finite() && normal != Vec3::ZERO).then_some((position, normal))
}

/// A camera whose picture has the run's size.
///
/// # Errors
/// A camera made for another size.
pub fn camera_of(cx: &CpuCx) -> Result<Camera, Problem> {
    let camera = Camera::from_words(cx.input(input::CAMERA.name).as_f32());
    let [width, height] = cx.image().map(|side| side as f64);
    if camera.size != [width, height] {
        return Err(Problem::new(Kind::BadValue, "camera is made for a picture of another size")
            .port(input::CAMERA.name)
            .expected(format!("{width} x {height}"))
            .found(format!("{} x {}", camera.size[0], camera.size[1])));
    }
    Ok(camera)
}

/// One view-sample for each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// World space; zeros for background.
    pub positions: Vec<[f32; 3]>,
    /// Unit, on the viewer's side; zeros for background.
    pub normals: Vec<[f32; 3]>,
    /// [`NO_TRIANGLE`] for background.
    pub triangles: Vec<u32>,
}

impl Seen {
    /// Background only.
    pub fn background(count: usize) -> Self {
        Self { positions: vec![[0.0; 3]; count], normals: vec![[0.0; 3]; count], triangles: vec![NO_TRIANGLE; count] }
    }

    /// Gives the outputs of the stage their values.
    pub fn put(self, cx: &mut CpuCx) {
        let count = self.triangles.len();
        cx.put(ports::POSITION.name, Array::f32([count, 3], self.positions.into_flattened()));
        cx.put(ports::NORMAL.name, Array::f32([count, 3], self.normals.into_flattened()));
        cx.put(ports::TRIANGLE.name, Array::u32([count], self.triangles));
        cx.put(ports::PIXEL.name, Array::u32([count], (0..count as u32).collect()));
    }
}

/// Rows of view-samples that one task owns.
pub struct Rows<'a> {
    /// First row.
    pub first: usize,
    /// Columns of the picture.
    pub width: usize,
    /// As in [`Seen`], of these rows.
    pub positions: &'a mut [[f32; 3]],
    /// Likewise.
    pub normals: &'a mut [[f32; 3]],
    /// Likewise.
    pub triangles: &'a mut [u32],
}

impl Rows<'_> {
    /// Positions and normals from the triangles; a pixel whose point is not finite becomes background.
    pub fn resolve(&mut self, corners: &[Corners], camera: &Camera) {
        for (index, triangle) in self.triangles.iter_mut().enumerate().filter(|(_, id)| **id != NO_TRIANGLE) {
            let (column, row) = (index % self.width, self.first + index / self.width);
            let ray = camera.ray(column as f64 + 0.5, row as f64 + 0.5);
            match seen_point(&corners[*triangle as usize], camera.eye, ray) {
                Some((position, normal)) => {
                    self.positions[index] = position.to_array();
                    self.normals[index] = normal.to_array();
                }
                None => *triangle = NO_TRIANGLE,
            }
        }
    }
}
