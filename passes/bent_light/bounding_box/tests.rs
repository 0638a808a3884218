use super::cpu::{bounds, cosine};
use crate::shared::hard_scenes::Random;
use crate::shared::shading::unit;
use glam::Vec3;

/// What `adjacent_faces` takes for a light's centre.
fn centre_cosine(normal: Vec3, at: Vec3, light: Vec3) -> f32 {
    unit(light - at).dot(normal)
}

#[test]
fn a_wide_light_over_a_floor_is_counted_by_hand() {
    // From the origin the box's corners are at height 3 or 5 and 4 to the sides along x: the lowest is at cosine 3 / 5.
    let light = bounds(&[[-4.0, 3.0, 0.0], [1.0, 5.0, 0.0], [4.0, 4.0, 0.0]]).expect("has points");
    assert_eq!(light, [Vec3::new(-4.0, 3.0, 0.0), Vec3::new(4.0, 5.0, 0.0)]);
    assert!((cosine(Vec3::Y, Vec3::ZERO, light) - 0.6).abs() < 1e-6);
    // A wall is black: half of the light is behind it.
    assert!(cosine(Vec3::X, Vec3::ZERO, light) < 0.0);
    assert_eq!(bounds(&[]), None);
}

#[test]
fn one_light_sample_is_the_light_s_centre_bit_for_bit() {
    let mut random = Random(3);
    for _ in 0..1000 {
        let (normal, at, light) =
            (unit(Vec3::from(random.point())), Vec3::from(random.point()), Vec3::from(random.point()) * 5.0);
        let one = bounds(&[light.to_array()]).expect("has a point");
        assert_eq!(cosine(normal, at, one), centre_cosine(normal, at, light));
    }
}

#[test]
fn the_corners_bound_every_point_of_the_box_and_find_its_sign() {
    let mut random = Random(11);
    let mut counts = [0; 2];
    for _ in 0..2000 {
        let (normal, at) = (unit(Vec3::from(random.point())), Vec3::from(random.point()));
        // Flat and solid boxes, near and far.
        let middle = Vec3::from(random.point()) * 4.0;
        let half = Vec3::from(random.point()).abs() * Vec3::new(1.0, f32::from(random.below(2) as u8), 1.0);
        let light = [middle - half, middle + half];
        let bend = cosine(normal, at, light);
        let mut least = f32::INFINITY;
        for _ in 0..200 {
            let point = middle + half * Vec3::from(random.point());
            least = least.min(centre_cosine(normal, at, point));
        }
        if bend >= 0.0 {
            assert!(least >= bend - 1e-5, "a point of the box has {least}, below {bend}");
        }
        counts[usize::from(bend < 0.0)] += 1;
        // Black wherever the whole box is behind: the sign needs no bound.
        let is_behind = (0..8).all(|bits| {
            let corner = Vec3::select(glam::BVec3::new(bits & 1 > 0, bits & 2 > 0, bits & 4 > 0), light[1], light[0]);
            (corner - at).dot(normal) < 0.0
        });
        assert!(!is_behind || bend < 0.0);
    }
    assert!(counts.iter().all(|count| *count > 300), "{counts:?}");
}
