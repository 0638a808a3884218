use super::*;

/// Looks along +z from (0, 0, -2); the window is [-1, 1] x [-0.5, 0.5].
fn face() -> Face {
    Face {
        origin: Vec3::new(0.0, 0.0, -2.0),
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Y,
        axis_z: Vec3::Z,
        window_low: [-1.0, -0.5],
        window_size: [2.0, 1.0],
        near: 1.0,
        far: 10.0,
    }
}

fn cube() -> Vec<Face> {
    let axes = [
        (Vec3::X, Vec3::Y, Vec3::Z),
        (Vec3::NEG_X, Vec3::Y, Vec3::Z),
        (Vec3::Y, Vec3::Z, Vec3::X),
        (Vec3::NEG_Y, Vec3::Z, Vec3::X),
        (Vec3::Z, Vec3::X, Vec3::Y),
        (Vec3::NEG_Z, Vec3::X, Vec3::Y),
    ];
    axes.map(|(axis_z, axis_x, axis_y)| Face { origin: Vec3::ZERO, axis_x, axis_y, axis_z, ..face() }).to_vec()
}

#[test]
fn words_round_trip() {
    let face = Face { axis_x: Vec3::new(0.6, 0.8, 0.0), far: 3.5, ..face() };
    let words = face.to_words();
    assert_eq!((words[3], words[7], words[11], words[15], words[16]), (1.0, -1.0, -0.5, 2.0, 1.0));
    assert_eq!((words[17], words[18], words[19]), (1.0, 3.5, 0.0));
    assert_eq!(Face::from_words(&words), face);
    assert_eq!(faces(&[words, words].concat()).len(), 2);
}

#[test]
fn a_point_lands_in_the_texel_counted_by_hand() {
    let faces = [face()];
    let point = project(&faces, Vec3::new(1.0, -0.5, 0.0)).unwrap();
    assert_eq!((point.u, point.v, point.depth), (0.5, -0.25, 2.0));
    // (0.5 + 1) / 2 * 4 = 3; (-0.25 + 0.5) / 1 * 4 = 1.
    assert_eq!(cell_of(&faces, Vec3::new(1.0, -0.5, 0.0), 4), Some((4 + 3, 2.0)));
}

#[test]
fn points_outside_the_window_land_in_border_texels() {
    let faces = [face()];
    for (position, expected) in
        [([100.0, 0.0, 0.0], [3, 2]), ([-100.0, 100.0, 0.0], [0, 3]), ([0.0, -9.0, 0.0], [2, 0])]
    {
        let point = project(&faces, position.into()).unwrap();
        assert_eq!(faces[0].texel(point.u, point.v, 4), expected);
    }
    assert_eq!(faces[0].texel(f32::INFINITY, f32::NEG_INFINITY, 4), [3, 0]);
}

#[test]
fn what_cannot_be_placed_is_none() {
    let faces = [face()];
    for z in [-2.0, -2.5, f32::NAN, f32::INFINITY] {
        assert_eq!(project(&faces, Vec3::new(0.0, 0.0, z)), None, "{z}");
    }
    assert_eq!(project(&cube(), Vec3::ZERO), None);
}

#[test]
fn the_face_furthest_along_is_chosen_and_the_lowest_of_equals() {
    let faces = cube();
    for (position, expected) in [
        ([3.0, 1.0, -2.0], 0),
        ([-3.0, 3.0, 0.0], 1),
        ([1.0, 1.0, 1.0], 0),
        ([0.5, -2.0, 2.0], 3),
        ([0.0, 0.1, -2.0], 5),
    ] {
        let point = project(&faces, position.into()).unwrap();
        assert_eq!(point.face, expected, "{position:?}");
        assert!(point.u.abs() <= 1.0 && point.v.abs() <= 1.0);
    }
    // A cell of face 5 lies past five whole faces.
    let (cell, _) = cell_of(&faces, Vec3::new(0.0, 0.1, -2.0), 4).unwrap();
    assert_eq!(cell / 16, 5);
}

#[test]
fn the_pad_covers_the_error_against_double_precision() {
    let axis_z = Vec3::new(0.3, -0.8, 0.52).normalize();
    let (axis_x, axis_y) = axis_z.any_orthonormal_pair();
    let origin = Vec3::new(3.7, 12.1, -5.3);
    let faces = [Face { origin, axis_x, axis_y, axis_z, ..face() }];
    let mut seed = 1u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
    };
    let (mut placed, mut largest) = (0, 0.0f64);
    for _ in 0..100_000 {
        let position = origin + Vec3::new(random(), random(), random()) * 40.0;
        let Some(point) = project(&faces, position) else { continue };
        let offset = position.as_dvec3() - origin.as_dvec3();
        // The exact coordinates: solve offset = w (u x + v y + z), as casters' footprints see the point.
        let frame = glam::DMat3::from_cols(axis_x.as_dvec3(), axis_y.as_dvec3(), axis_z.as_dvec3());
        let exact = frame.inverse() * offset;
        let error = (exact.x / exact.z - f64::from(point.u)).abs().max((exact.y / exact.z - f64::from(point.v)).abs());
        largest = largest.max(error / f64::from(uv_pad(point.u, point.v)));
        placed += 1;
    }
    assert!(placed > 40_000);
    assert!(largest < 1.0, "{largest}");
    assert!(largest > 0.05, "the pad is needlessly wide: {largest}");
}

#[test]
fn placing_many_is_placing_each() {
    let mut seed = 9u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 22) as f32 - 2.0
    };
    let mut positions: Vec<[f32; 3]> = (0..1001).map(|_| [noise(), noise(), noise() - 1.0]).collect();
    positions.extend([[0.0, 0.0, -2.0], [f32::NAN; 3], [0.0, 0.0, f32::INFINITY], [3e38, -3e38, 3e38], [0.0; 3]]);
    for faces in [vec![face()], cube()] {
        for side in [1, 3, 512, 4096] {
            let (mut cells, mut depths) = (vec![7; positions.len()], vec![7.0; positions.len()]);
            cells_of(&faces, &positions, side, &mut cells, &mut depths);
            for ((position, cell), depth) in positions.iter().zip(&cells).zip(&depths) {
                match cell_of(&faces, Vec3::from(*position), side) {
                    Some(placed) => assert_eq!((*cell as usize, *depth), placed, "{position:?}"),
                    None => assert_eq!(*depth, 0.0, "{position:?}"),
                }
            }
        }
    }
}
