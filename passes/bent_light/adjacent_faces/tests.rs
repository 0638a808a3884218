use super::cpu::cosine;
use crate::bent_light::around::Mesh;
use crate::shared::shading::Corners;
use glam::Vec3;

fn smallest(
    triangles: &[Corners],
    corner_vertex: &[[u32; 3]],
    face_offset: &[u32],
    faces: &[u32],
    light: Vec3,
) -> Vec<[f32; 3]> {
    Mesh { triangles, corner_vertex, face_offset, faces }.smallest(|normal, at| cosine(normal, at, light))
}

#[test]
fn a_ridge_takes_the_darker_of_its_two_faces_and_keeps_the_other_corners() {
    // Two faces of a roof along z share corners 0 and 1 of the ridge; the light is above and to the left of it.
    let (a, b, left, right) = ([0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let triangles = [[a, left, b], [a, b, right]];
    let light = Vec3::new(-1.0, 2.0, 0.0);
    let found = smallest(&triangles, &[[0, 2, 1], [0, 1, 3]], &[0, 2, 4, 5, 6], &[0, 1, 0, 1, 0, 1], light);
    // Normals (-1, 1, 0)/sqrt 2 and (1, 1, 0)/sqrt 2; from the ridge's start the light is at (-1, 1, 0)/sqrt 2.
    assert!(found[0][0].abs() < 1e-6 && found[1][0].abs() < 1e-6, "{found:?}");
    assert!(found[0][0] == found[1][0] && found[0][2] == found[1][1]);
    // The lower corners have one face each.
    assert!((found[0][1] - 0.5f32.sqrt()).abs() < 1e-6, "{found:?}");
    assert!(found[1][2].abs() < 1e-6, "{found:?}");
}

#[test]
fn a_face_turned_away_is_black_at_all_its_corners_even_if_no_list_names_it() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let found = smallest(&[triangle], &[[0, 1, 2]], &[0, 0, 0, 0], &[], Vec3::new(0.2, 3.0, 0.2));
    assert!(found[0].iter().all(|cosine| *cosine < 0.0), "{found:?}");
}

#[test]
fn degenerate_triangles_do_not_darken_their_neighbours() {
    let triangle = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    let point = [[0.0; 3]; 3];
    let found =
        smallest(&[triangle, point], &[[0, 1, 2], [0, 0, 0]], &[0, 2, 3, 4], &[0, 1, 0, 0], Vec3::new(0.0, 1.0, 0.0));
    assert_eq!(found[0][0], 1.0);
    assert_eq!(smallest(&[point], &[[0; 3]], &[0, 1], &[0], Vec3::ONE), [[0.0; 3]]);
    assert!(smallest(&[], &[], &[0], &[], Vec3::ONE).is_empty());
}
