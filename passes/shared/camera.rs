//! The pinhole camera as its twenty words say it (`shadowgraph_core::input::camera_words`), in f64.

use glam::{DMat3, DVec3, Vec3};

/// The camera in WGSL; reads a binding named `camera`.
pub const WGSL: &str = include_str!("camera.wgsl");

/// World space; the axes are the stored f32 words, orthonormal to their rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Centre of projection.
    pub eye: DVec3,
    /// Direction of growing columns.
    pub right: DVec3,
    /// Direction of falling rows.
    pub up: DVec3,
    /// Direction of view.
    pub forward: DVec3,
    /// Tangents of half the horizontal and vertical angle.
    pub tan: [f64; 2],
    /// Width and height, pixels.
    pub size: [f64; 2],
    /// Components along right, up and forward of a world vector. The exact inverse of the stored axes: were these taken as
    /// orthonormal, a point on a pixel's ray would project beside the pixel by their rounding.
    camera_from_world: DMat3,
}

impl Camera {
    /// From its words; panics on fewer than twenty.
    pub fn from_words(words: &[f32]) -> Self {
        let vector = |start: usize| Vec3::from_slice(&words[start..start + 3]).as_dvec3();
        let [eye, right, up, forward] = [0, 4, 8, 12].map(vector);
        Self {
            eye,
            right,
            up,
            forward,
            tan: [words[7].into(), words[11].into()],
            size: [words[16].into(), words[17].into()],
            camera_from_world: DMat3::from_cols(right, up, forward).inverse(),
        }
    }

    /// Along the point (column, row) of the picture, pixel centres at halves, one unit deep; not of unit length.
    #[inline]
    pub fn ray(&self, column: f64, row: f64) -> DVec3 {
        let across = 2.0 * column / self.size[0] - 1.0;
        let upwards = 1.0 - 2.0 * row / self.size[1];
        self.forward + across * self.tan[0] * self.right + upwards * self.tan[1] * self.up
    }

    /// Homogeneous picture coordinates of `position`: (column w, row w, w) with w the depth, so that `position` is eye + w
    /// ray(column, row). Linear in the position, so a triangle that crosses the eye plane needs no clipping before it.
    #[inline]
    pub fn project(&self, position: Vec3) -> DVec3 {
        let DVec3 { x, y, z: depth } = self.camera_from_world * (position.as_dvec3() - self.eye);
        let column = (x / self.tan[0] + depth) * self.size[0] * 0.5;
        let row = (depth - y / self.tan[1]) * self.size[1] * 0.5;
        DVec3::new(column, row, depth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowgraph_core::{input, scene};

    fn camera() -> Camera {
        let camera = scene::Camera {
            name: "test".into(),
            eye: [1.0, 2.0, 3.0],
            target: [1.0, 2.0, -7.0],
            up: [0.0, 1.0, 0.0],
            fov_y: std::f32::consts::FRAC_PI_2,
        };
        Camera::from_words(&input::camera_words(&camera, [200, 100]))
    }

    #[test]
    fn the_corner_ray_is_the_one_counted_by_hand() {
        let ray = camera().ray(0.0, 0.0);
        assert!((ray - DVec3::new(-2.0, 1.0, -1.0)).length() < 1e-6, "{ray}");
    }

    #[test]
    fn projection_undoes_the_ray_however_the_axes_are_rounded() {
        let mut camera = camera();
        assert!(camera.project(Vec3::new(1.0, 2.0, 4.0)).z < 0.0);
        camera = Camera::from_words(&[
            0.0, 0.0, 0.0, 0.0, 1.0, 1e-3, 0.0, 1.0, 0.0, 1.0, 2e-3, 1.0, 0.0, 0.0, -1.0, 0.0, 64.0, 64.0, 0.0, 0.0,
        ]);
        for (column, row, depth) in [(0.5, 0.5, 2.0), (50.25, 7.5, 0.25), (63.5, 31.5, 8.0)] {
            let position = (camera.eye + depth * camera.ray(column, row)).as_vec3();
            let projected = camera.project(position);
            assert!((projected.x / projected.z - column).abs() < 1e-5);
            assert!((projected.y / projected.z - row).abs() < 1e-5);
            assert!((projected.z - depth).abs() < 1e-6);
        }
    }
}
