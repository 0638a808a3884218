use super::cpu::whole;
use crate::shared::light_fit::LARGEST_TANGENT;
use glam::Vec3;
use shadowgraph_core::shared::{BACKGROUND, KEPT};

const BOX: [[f32; 3]; 2] = [[-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]];

#[test]
fn a_box_below_the_light_gives_the_window_counted_by_hand() {
    let (face, behind) = whole(&[[0.0; 3]], &[KEPT], &[[0.0, 4.0, 0.0]], &BOX);
    assert_eq!((behind, face.valid), (0, true));
    // The upper corners lie 2 below the light and 1 aside: tangents of a half.
    assert!((face.axis_z - Vec3::NEG_Y).length() < 1e-6);
    for axis in 0..2 {
        assert!((face.window_low[axis] + 0.5).abs() < 1e-4 && (face.window_size[axis] - 1.0).abs() < 1e-4);
    }
    assert!((face.near - 2.0).abs() < 1e-4 && (face.far - 4.0).abs() < 1e-4);
}

#[test]
fn the_window_does_not_depend_on_view_samples_but_depths_reach_them() {
    let light = [[3.0, 9.0, 1.0]];
    let (empty, _) = whole(&[], &[], &light, &BOX);
    let (face, _) = whole(&[[0.1, 0.2, 0.3], [-6.0, -18.0, -2.0]], &[KEPT, KEPT], &light, &BOX);
    assert!(!empty.valid && face.valid);
    assert_eq!((empty.window_low, empty.window_size), (face.window_low, face.window_size));
    assert_eq!(empty.near, face.near);
    assert!(face.far > 2.0 * empty.far);
}

#[test]
fn a_light_inside_the_box_takes_the_widest_window_and_counts_what_is_behind() {
    let light = [[0.0, 1.5, 0.0]];
    let (face, behind) = whole(&[[0.0, 1.9, 0.0], [0.0; 3], [0.0, 1.9, 0.0]], &[KEPT, KEPT, BACKGROUND], &light, &BOX);
    assert_eq!(behind, 1);
    assert_eq!(face.window_size, [2.0 * LARGEST_TANGENT; 2]);
    assert!(face.near > 0.0 && face.near < face.far);
}

#[test]
fn an_empty_scene_gives_finite_words() {
    for light in [[0.0; 3], [0.0, 5.0, 0.0]] {
        let (face, _) = whole(&[], &[], &[light], &[[0.0; 3]; 2]);
        assert!(!face.valid && face.to_words().iter().all(|word| word.is_finite()));
        assert!(face.window_size[0] > 0.0 && face.near < face.far);
    }
}
