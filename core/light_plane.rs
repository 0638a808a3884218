//! The plane that light samples lie in, if they lie in one.
//!
//! The plane goes through the first sample, the one farthest from it and the one farthest from the line through both. A sample
//! lies in it within a millionth of the light's extent and the rounding of its coordinates: a light that is small beside its
//! distance from the origin has no flatter points.

use glam::{DVec3, Vec3};

/// How far off the plane a light sample may lie, of the light's extent.
pub const SHARE: f32 = 1e-6;
/// And of the largest coordinate: each is off by half a unit in the last place, in the sample itself and in the three that make
/// the plane.
pub const ROUNDING: f32 = 4.0 * f32::EPSILON;

/// A plane through a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPlane {
    /// The first light sample.
    pub origin: DVec3,
    /// Unit vector in the plane, towards the sample farthest from the first.
    pub axis: DVec3,
    /// Unit normal; of a segment or a point, one of many.
    pub normal: DVec3,
    /// How far off the plane a sample may lie, scene units.
    pub tolerance: f64,
}

impl LightPlane {
    /// That of `samples`.
    pub fn of(samples: &[[f32; 3]]) -> Self {
        let origin = samples.first().map_or(DVec3::ZERO, |first| point(*first));
        // The first of the longest.
        let longest = |vectors: &mut dyn Iterator<Item = DVec3>| {
            vectors.fold(DVec3::ZERO, |best, one| if one.length_squared() > best.length_squared() { one } else { best })
        };
        let offsets = || samples.iter().map(|sample| point(*sample) - origin);
        let far = longest(&mut offsets());
        let axis = far.try_normalize().unwrap_or(DVec3::X);
        let largest = samples.iter().flatten().fold(0.0f32, |most, x| most.max(x.abs()));
        let tolerance = f64::from(SHARE) * far.length() + f64::from(ROUNDING) * f64::from(largest);
        let other = axis.cross(if axis.x.abs() > 0.5 { DVec3::Y } else { DVec3::X }).normalize_or(DVec3::Y);
        let across = longest(&mut offsets().map(|offset| axis.cross(offset)));
        let normal = if across.length() > tolerance { across.normalize_or(other) } else { other };
        // One of two.
        let normal = if normal.dot(other) < 0.0 { -normal } else { normal };
        Self { origin, axis, normal, tolerance }
    }

    /// Whether `sample` lies in the plane.
    pub fn has(&self, sample: [f32; 3]) -> bool {
        self.normal.dot(point(sample) - self.origin).abs() <= self.tolerance
    }

    /// Distance of the plane from `point` along the normal.
    pub fn offset_from(&self, point: DVec3) -> f64 {
        self.normal.dot(self.origin - point)
    }
}

fn point(sample: [f32; 3]) -> DVec3 {
    Vec3::from(sample).as_dvec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a triangle across (3, 10, 2), and what lies between them, moved by `off` along the normal (3, 10, 2).
    fn samples(off: f32) -> Vec<[f32; 3]> {
        let at = |u: f32, v: f32, off: f32| {
            [3.0 + u + 3.0 * off, 10.0 - 0.3 * u - 0.2 * v + 10.0 * off, 2.0 + v + 2.0 * off]
        };
        vec![at(-0.3, -0.3, 0.0), at(0.4, 0.0, 0.0), at(-0.1, 0.5, 0.0), at(0.1, 0.1, off)]
    }

    #[test]
    fn rounding_is_let_pass_and_more_is_not() {
        let flat = samples(0.0);
        let plane = LightPlane::of(&flat);
        assert!(flat.iter().all(|sample| plane.has(*sample)));
        assert!((plane.normal.dot(DVec3::new(3.0, 10.0, 2.0).normalize())).abs() > 1.0 - 1e-6);
        let bent = samples(1e-5);
        assert!(!LightPlane::of(&bent).has(bent[3]));
    }

    #[test]
    fn points_and_segments_lie_in_a_plane_with_unit_axes() {
        let segment: Vec<[f32; 3]> = (0..5).map(|k| [k as f32, 1.0, -0.5 * k as f32]).collect();
        for samples in [&[][..], &[[1.0, 2.0, 3.0]], &[[0.0; 3]; 2], &segment] {
            let plane = LightPlane::of(samples);
            assert!(samples.iter().all(|sample| plane.has(*sample)));
            assert!((plane.normal.length() - 1.0).abs() < 1e-12 && plane.normal.dot(plane.axis).abs() < 1e-12);
        }
    }
}
