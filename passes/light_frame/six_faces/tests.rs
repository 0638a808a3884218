use super::cpu::{cube, six_faces};
use crate::shared::light_frame::project;
use glam::Vec3;
use shadowgraph_core::shared::{BACKGROUND, KEPT};

#[test]
fn axes_are_right_handed_and_in_the_agreed_order() {
    let faces = cube(Vec3::ZERO);
    let order = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    for (face, axis_z) in faces.iter().zip(order) {
        assert_eq!(face.axis_z, axis_z);
        assert_eq!(face.axis_x.cross(face.axis_y), axis_z);
    }
}

#[test]
fn each_face_is_fitted_to_its_own_view_samples() {
    let light = [[1.0, 1.0, 1.0]];
    let positions = [[3.0, 2.0, 1.0], [5.0, 1.0, 1.0], [1.0, -3.0, 1.0], [9.0, 9.0, 9.0], [1.0; 3]];
    let states = [KEPT, KEPT, KEPT, BACKGROUND, KEPT];
    let (faces, behind) = six_faces(&positions, &states, &light, true);
    assert_eq!(behind, 1);
    assert_eq!(faces.map(|face| face.valid), [true, false, false, true, false, false]);
    // On +x: (u, v) = (y, z) / x: (0.5, 0) at depth 2 and (0, 0) at depth 4.
    assert!(faces[0].window_low[0].abs() < 1e-4 && (faces[0].window_size[0] - 0.5).abs() < 1e-4);
    assert!((faces[0].near - 2.0).abs() < 1e-4 && (faces[0].far - 4.0).abs() < 1e-4);
    assert_eq!(faces[1].window_size, [2.0; 2]);
    let (whole, _) = six_faces(&positions, &states, &light, false);
    assert_eq!((whole[0].window_low, whole[0].window_size), ([-1.0; 2], [2.0; 2]));
    assert_eq!((whole[0].near, whole[0].far, whole[0].valid), (faces[0].near, faces[0].far, true));
}

#[test]
fn the_quick_choice_of_a_face_is_that_of_the_shared_projection() {
    let mut seed = 3u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        // Few values, so that ties between axes are common.
        ((seed >> 24) % 5) as f32 - 2.0
    };
    for _ in 0..500 {
        let position = [random(), random(), random()];
        let (faces, behind) = six_faces(&[position], &[KEPT], &[[0.0; 3]], true);
        match project(&cube(Vec3::ZERO), position.into()) {
            None => assert_eq!(behind, 1),
            Some(point) => {
                assert!(faces[point.face].valid, "{position:?}");
                let window = faces[point.face].window_low;
                assert!((window[0] - point.u).abs() < 1e-4 && (window[1] - point.v).abs() < 1e-4);
            }
        }
    }
}

#[test]
fn no_view_samples_leave_whole_faces() {
    let (faces, behind) = six_faces(&[], &[], &[[0.0; 3]], true);
    assert!(behind == 0 && faces.iter().all(|face| !face.valid && face.window_size == [2.0; 2]));
}
