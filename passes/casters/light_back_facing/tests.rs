use super::cpu::casts;
use crate::shared::hard_scenes::Random;
use crate::shared::predicate::{Corners, blocks};
use shadowgraph_core::scene::flag;

/// Counter-clockwise seen from above (positive y).
const FLOOR: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
const ABOVE: [f32; 3] = [0.2, 3.0, 0.2];
const BELOW: [f32; 3] = [0.2, -3.0, 0.2];

#[test]
fn only_the_back_of_a_closed_mesh_casts() {
    assert!(!casts(&FLOOR, flag::CLOSED, &[ABOVE]));
    assert!(casts(&FLOOR, flag::CLOSED, &[BELOW]));
    assert!(casts(&FLOOR, 0, &[ABOVE]) && casts(&FLOOR, 0, &[BELOW]));
    assert!(!casts(&FLOOR, flag::CLOSED | flag::TWO_SIDED, &[ABOVE]));
}

#[test]
fn one_light_sample_behind_is_enough() {
    assert!(casts(&FLOOR, flag::CLOSED, &[ABOVE, ABOVE, BELOW]));
}

#[test]
fn edge_on_and_degenerate_triangles_of_closed_meshes_do_not_cast() {
    assert!(!casts(&FLOOR, flag::CLOSED, &[[7.0, 0.0, 9.0]]));
    assert!(!casts(&[[0.0; 3], [1.0; 3], [2.0; 3]], flag::CLOSED, &[BELOW]));
}

#[test]
fn the_smallest_step_off_the_plane_decides() {
    // The plane x + y + z = 3 through points whose coordinates f32 holds, and light samples one unit in the last place off it.
    let plane = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
    assert!(!casts(&plane, flag::CLOSED, &[[1.0, 1.0, 1.0]]));
    assert!(!casts(&plane, flag::CLOSED, &[[1.0, 1.0, 1.0f32.next_up()]]));
    assert!(casts(&plane, flag::CLOSED, &[[1.0, 1.0, 1.0f32.next_down()]]));
}

#[test]
fn of_a_closed_tetrahedron_some_triangles_cast_and_some_do_not() {
    let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let sides = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
    let cast = |light: [f32; 3]| sides.map(|side| casts(&side, flag::CLOSED, &[light]));
    assert_eq!(cast([5.0, 5.0, 5.0]), [true, true, true, false]);
    assert_eq!(cast([-1.0, -1.0, -1.0]), [false, false, false, true]);
    // From within, every side shows its back.
    assert_eq!(cast([0.1, 0.1, 0.1]), [true; 4]);
}

/// The cube from -1 to 1, outwards.
fn cube() -> Vec<Corners> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [-1.0f32, 1.0] {
            let corner = |u: f32, v: f32| {
                let mut corner = [side; 3];
                (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (u, v * side);
                corner
            };
            let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

#[test]
fn an_area_light_loses_no_shadow_of_a_closed_mesh() {
    let mut random = Random(11);
    let triangles = cube();
    let (mut left_out, mut blocked) = (0, 0);
    for _ in 0..200 {
        let middle = random.point().map(|x| 6.0 * x);
        let samples: Vec<[f32; 3]> = (0..20)
            .map(|_| random.point())
            .map(|p| [0, 1, 2].map(|k| middle[k] + 1.5 * p[k]))
            .filter(|p| p.iter().any(|x| x.abs() > 1.0))
            .collect();
        let cast: Vec<&Corners> = triangles.iter().filter(|corners| casts(corners, flag::CLOSED, &samples)).collect();
        left_out += triangles.len() - cast.len();
        for _ in 0..20 {
            let position = random.point().map(|x| 4.0 * x);
            if position.iter().all(|x| x.abs() <= 1.0) {
                continue;
            }
            for sample in &samples {
                let all = triangles.iter().any(|corners| blocks(position, None, corners, *sample));
                assert_eq!(cast.iter().any(|corners| blocks(position, None, corners, *sample)), all);
                blocked += u32::from(all);
            }
        }
    }
    assert!(left_out > 300 && blocked > 1000, "{left_out} {blocked}");
}
