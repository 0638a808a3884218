use super::cpu::second;
use crate::shared::light_frame::Face;
use crate::shared::shadow_map::linear_from_depth;
use glam::Vec3;

#[test]
fn the_second_of_three_sheets_is_kept_and_a_single_one_is_not() {
    let face = Face {
        origin: Vec3::ZERO,
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Z,
        axis_z: -Vec3::Y,
        window_low: [-1.0; 2],
        window_size: [2.0; 2],
        near: 1.0,
        far: 4.0,
    };
    let sheet = |y: f32| [[-9.0, y, -9.0], [9.0, y, -9.0], [0.0, y, 30.0]];
    let depths = |triangles: &[[[f32; 3]; 3]]| second(&face.to_words(), 16, triangles, &vec![1; triangles.len()]);
    let three = depths(&[sheet(-3.0), sheet(-1.5), sheet(-2.0)]);
    assert!(three.iter().all(|depth| (linear_from_depth(*depth, 4.0) - 2.0).abs() < 1e-3));
    assert!(depths(&[sheet(-2.0)]).iter().all(|depth| *depth == 1.0));
    // The same sheet twice is one surface.
    assert!(depths(&[sheet(-2.0), sheet(-2.0)]).iter().all(|depth| *depth == 1.0));
}
