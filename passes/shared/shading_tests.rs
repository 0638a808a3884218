use super::*;

#[test]
fn normals_and_units_hold_at_every_scale() {
    for scale in [1.0f32, 1e-30, 1e37] {
        let corners = [[0.0, 0.0, 0.0], [0.0, 0.0, scale], [scale, 0.0, 0.0]];
        assert_eq!(face_normal(&corners), Vec3::Y, "{scale}");
        assert!((unit(Vec3::new(3.0, 4.0, 0.0) * scale) - Vec3::new(0.6, 0.8, 0.0)).length() < 1e-6, "{scale}");
    }
    assert_eq!(unit(Vec3::ZERO), Vec3::ZERO);
    assert_eq!(face_normal(&[[1.0; 3]; 3]), Vec3::ZERO);
    assert_eq!(face_normal(&[[0.0; 3], [1.0; 3], [2.0; 3]]), Vec3::ZERO);
}

#[test]
fn weights_give_the_point_back() {
    let corners = [[1.0f32, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    for expected in [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.3, 0.5], [0.5, 0.5, 0.0]] {
        let at = [0, 1, 2].map(|axis| (0..3).map(|k| expected[k] * corners[k][axis]).sum::<f32>());
        let found = weights(&corners, Vec3::from(at));
        assert!((found - Vec3::from(expected)).length() < 1e-5, "{found}");
    }
    // Past an edge the weights stay on it; without area they are equal.
    let outside = weights(&corners, Vec3::new(1.5, -0.5, 0.0));
    assert!(outside.min_element() >= 0.0 && (outside.element_sum() - 1.0).abs() < 1e-6);
    assert_eq!(weights(&[[1.0; 3]; 3], Vec3::ONE), Vec3::splat(1.0 / 3.0));
}
