use super::cpu::fitted;
use crate::shared::light_fit::PAD;
use crate::shared::light_frame::project;
use glam::Vec3;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT};

const LIGHT: [[f32; 3]; 1] = [[0.0, 4.0, 0.0]];

#[test]
fn a_square_floor_below_the_light_gives_the_window_counted_by_hand() {
    let floor = [[-2.0, 0.0, -1.0], [2.0, 0.0, -1.0], [-2.0, 0.0, 1.0], [2.0, 0.0, 1.0]];
    let (face, behind) = fitted(&floor, &[KEPT; 4], &LIGHT);
    assert_eq!((behind, face.valid, face.origin), (0, true, Vec3::new(0.0, 4.0, 0.0)));
    // Straight down, axis x along the world's x; tangents 2/4 and 1/4.
    assert!((face.axis_z - Vec3::NEG_Y).length() < 1e-6 && (face.axis_x - Vec3::X).length() < 1e-6);
    assert!((face.window_low[0] + 0.5).abs() < 1e-4 && (face.window_low[1] + 0.25).abs() < 1e-4);
    assert!((face.window_size[0] - 1.0).abs() < 1e-4 && (face.window_size[1] - 0.5).abs() < 1e-4);
    assert!((face.near - 4.0).abs() <= 8.0 * PAD && (face.far - 4.0).abs() <= 8.0 * PAD && face.near < face.far);
}

#[test]
fn only_kept_view_samples_count() {
    let positions = [[1.0, 0.0, 0.0], [1e9, 0.0, 0.0], [f32::NAN; 3], [-1.0, 0.0, 0.0], [0.0, 1e9, 0.0]];
    let (face, behind) = fitted(&positions, &[KEPT, FACING_AWAY, BACKGROUND, KEPT, BACKGROUND], &LIGHT);
    assert_eq!(behind, 0);
    assert!((face.window_size[0] - 0.5).abs() < 1e-4, "{face:?}");
}

#[test]
fn no_view_samples_give_a_frame_that_is_finite_and_not_valid() {
    for (positions, states) in [(vec![], vec![]), (vec![[f32::NAN; 3]; 3], vec![BACKGROUND; 3])] {
        let (face, behind) = fitted(&positions, &states, &LIGHT);
        assert!(!face.valid && behind == 0 && face.to_words().iter().all(|word| word.is_finite()));
        assert!(face.window_size[0] > 0.0 && face.near < face.far);
    }
}

#[test]
fn a_lone_view_sample_and_one_at_the_light_are_survived() {
    let (face, behind) = fitted(&[[3.0, -1.0, 2.0]], &[KEPT], &LIGHT);
    assert!(face.valid && behind == 0 && face.window_size[0] > 0.0 && face.near < face.far);
    let (face, behind) = fitted(&LIGHT, &[KEPT], &LIGHT);
    assert!(!face.valid && behind == 1 && face.to_words().iter().all(|word| word.is_finite()));
}

#[test]
fn view_samples_all_around_the_light_are_counted() {
    let around = [[1.0, 4.0, 0.0], [-1.0, 4.0, 0.0], [0.0, 5.0, 0.0], [0.0, 3.0, 0.0]];
    let (_, behind) = fitted(&around, &[KEPT; 4], &LIGHT);
    assert!(behind >= 3);
}

#[test]
fn every_placed_view_sample_lies_inside_the_window_and_the_depth_range() {
    for (light, count) in [([30.0, 17.0, -4.0], 1), ([0.3, 6.0, 0.2], 63), ([-8.0, 7.0, 5.0], 40_001)] {
        let mut seed = 7u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        let positions: Vec<[f32; 3]> = (0..count).map(|_| [random(), random(), random()].map(|x| x * 10.0)).collect();
        let (face, behind) = fitted(&positions, &vec![KEPT; count], &[light]);
        assert_eq!(behind, 0);
        for position in positions {
            let point = project(&[face], position.into()).unwrap();
            for (value, axis) in [(point.u, 0), (point.v, 1)] {
                let inside = (value - face.window_low[axis]) / face.window_size[axis];
                assert!(inside > 0.0 && inside < 1.0, "{inside}");
            }
            assert!(face.near < point.depth && point.depth < face.far);
        }
    }
}

#[test]
fn axes_are_orthonormal_and_right_handed() {
    for light in [[1.0, 2.0, 3.0], [5.0, 5.0, 5.0], [0.0, -3.0, 1e-4], [1e6, 2e6, -1e6]] {
        let (face, _) = fitted(&[[0.0; 3]], &[KEPT], &[light]);
        assert!((face.axis_x.cross(face.axis_y) - face.axis_z).length() < 1e-6, "{face:?}");
        assert!((face.axis_x.length() - 1.0).abs() < 1e-6 && face.axis_x.dot(face.axis_z).abs() < 1e-6);
    }
}

#[test]
fn the_origin_is_the_mean_of_the_light_samples() {
    let (face, _) = fitted(&[[0.0; 3]], &[KEPT], &[[0.0, 4.0, 0.0], [2.0, 4.0, 0.0], [1.0, 7.0, 3.0]]);
    assert_eq!(face.origin, Vec3::new(1.0, 5.0, 1.0));
}
