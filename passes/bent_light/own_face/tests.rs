use super::cpu::cosines;
use glam::Vec3;

#[test]
fn a_corner_right_below_the_light_has_cosine_one_and_the_back_has_minus_one() {
    let front = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    let back = [front[0], front[2], front[1]];
    let found = cosines(&[front, back, [[2.0; 3]; 3]], Vec3::new(0.0, 1.0, 0.0));
    let diagonal = 0.5f32.sqrt();
    for (found, expected) in
        found.concat().iter().zip([1.0, diagonal, diagonal, -1.0, -diagonal, -diagonal, 0.0, 0.0, 0.0])
    {
        assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
    }
    // A light in the corner itself has no direction.
    assert_eq!(cosines(&[front], Vec3::ZERO)[0][0], 0.0);
}
