use super::*;
use shadowgraph_core::scene::flag;

type Corners = [[f32; 3]; 3];

/// A tetrahedron at (x, 0, 0), counter-clockwise seen from outside.
fn tetrahedron(x: f32) -> Vec<Corners> {
    let [o, a, b, c] = [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.0, 1.0]];
    vec![[o, b, a], [o, a, c], [o, c, b], [a, b, c]]
}

fn flipped(triangles: Vec<Corners>) -> Vec<Corners> {
    triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}

fn parts(shapes: &[Vec<Corners>]) -> Parts {
    let numbers = shapes.iter().enumerate().flat_map(|(shape, triangles)| vec![shape as u32; triangles.len()]);
    find_parts(&shapes.concat(), &numbers.collect::<Vec<_>>())
}

fn counted(shapes: &[Vec<Corners>]) -> (usize, usize) {
    let parts = parts(shapes);
    (parts.parts_count, parts.closed_count)
}

#[test]
fn a_tetrahedron_is_closed_until_a_face_is_missing_or_turned() {
    assert_eq!(counted(&[tetrahedron(0.0)]), (1, 1));
    assert_eq!(parts(&[tetrahedron(0.0)]).closed_flag, [flag::CLOSED; 4]);
    assert_eq!(counted(&[tetrahedron(0.0)[1..].to_vec()]), (1, 0));
    let mut turned = tetrahedron(0.0);
    turned[2].swap(0, 1);
    assert_eq!(counted(&[turned]), (1, 0));
    let mut doubled = tetrahedron(0.0);
    doubled.push(doubled[0]);
    assert_eq!(counted(&[doubled]), (1, 0));
}

#[test]
fn inside_out_solids_and_folded_sheets_stay_open() {
    assert_eq!(counted(&[flipped(tetrahedron(0.0))]), (1, 0));
    let sheet = vec![tetrahedron(0.0)[0]];
    assert_eq!(counted(&[[sheet.clone(), flipped(sheet)].concat()]), (1, 0));
    // Far from the origin the volume must not drown in rounding.
    assert_eq!(counted(&[tetrahedron(65536.0)]), (1, 1));
}

#[test]
fn touching_solids_stay_apart_and_split_solids_are_made_whole() {
    // The two share the corner (1, 0, 0) and no edge; mirrored on x = 0 they share an edge with four faces.
    assert_eq!(counted(&[tetrahedron(0.0), tetrahedron(1.0)]), (2, 2));
    let mirrored = flipped(tetrahedron(0.0).into_iter().map(|corners| corners.map(|[x, y, z]| [-x, y, z])).collect());
    assert_eq!(counted(&[tetrahedron(0.0), mirrored.clone()]), (2, 2));
    assert_eq!(counted(&[[tetrahedron(0.0), mirrored].concat()]), (1, 0));
    let (front, back) = (tetrahedron(0.0)[..2].to_vec(), tetrahedron(0.0)[2..].to_vec());
    assert_eq!(counted(&[front.clone(), back.clone()]), (1, 1));
    assert_eq!(counted(&[front, back, tetrahedron(5.0)[1..].to_vec()]), (2, 1));
}

#[test]
fn triangles_with_two_equal_corners_do_not_open_a_part_and_minus_zero_is_zero() {
    let mut pinched = tetrahedron(0.0);
    let [a, b, _] = pinched[0];
    pinched.push([a, b, b]);
    assert_eq!(counted(&[pinched]), (1, 1));
    let mut signed = tetrahedron(0.0);
    signed[0][0] = [-0.0, 0.0, -0.0];
    assert_eq!(counted(&[signed]), (1, 1));
    assert_eq!(counted(&[]), (0, 0));
}

#[test]
fn smooth_vertices_need_equal_positions_and_normals_in_one_shape() {
    let positions = tetrahedron(0.0);
    let up = [[0.0, 1.0, 0.0]; 3];
    let one = smooth_vertices(&positions, &[up; 4], &[0; 4]);
    assert_eq!(one.face_offset, [0, 3, 6, 9, 12]);
    assert_eq!(one.corner_vertex[0], [0, 1, 2]);
    // Triangles around the first corner, ascending.
    assert_eq!(one.faces[..3], [0, 1, 2]);

    let creased = smooth_vertices(&positions, &[up, up, up, [[0.0, 0.0, 1.0]; 3]], &[0; 4]);
    assert_eq!(creased.face_offset.len() - 1, 7);
    let shapes = smooth_vertices(&positions, &[up; 4], &[0, 0, 1, 1]);
    assert_eq!(shapes.face_offset.len() - 1, 8);
    assert_eq!(shapes.faces.len(), 12);

    let pinched = smooth_vertices(&[[[0.0; 3], [0.0; 3], [1.0; 3]]], &[up], &[0]);
    assert_eq!((pinched.face_offset, pinched.faces), (vec![0, 1, 2], vec![0, 0]));
}

#[test]
fn interning_many_keys_gives_each_its_own_number() {
    let mut table = super::intern::Intern::<2>::with_capacity(0);
    let key = |index: u32| [index % 257, index / 257];
    for index in 0..100_000 {
        assert_eq!(table.number(key(index)), index);
    }
    assert!((0..100_000).rev().all(|index| table.number(key(index)) == index));
}

#[test]
fn a_part_around_the_eye_is_opened_and_no_other() {
    let positions = [tetrahedron(0.0), tetrahedron(5.0)].concat();
    let scene = |eye: [f32; 3]| {
        let mut scene = shadowgraph_core::scene::Scene { positions: positions.clone(), ..Default::default() };
        scene.flags = vec![flag::CLOSED | flag::TWO_SIDED; 8];
        (open_parts_around(&mut scene, eye), scene.flags)
    };
    let (closed, open) = ([flag::CLOSED | flag::TWO_SIDED; 4], [flag::TWO_SIDED; 4]);
    assert_eq!(scene([0.1, 0.1, 0.1]), (1, [open, closed].concat()));
    assert_eq!(scene([5.1, 0.1, 0.1]), (1, [closed, open].concat()));
    // On a face, where nothing can be sure.
    assert_eq!(scene([0.2, 0.2, 0.0]).0, 1);
    assert_eq!(scene([0.5, 0.5, 0.5]), (0, [closed, closed].concat()));
    assert_eq!(scene([0.2, 0.2, -0.001]).0, 0);

    let mut all = shadowgraph_core::scene::Scene { flags: vec![flag::CLOSED, flag::TWO_SIDED], ..Default::default() };
    open_all_parts(&mut all);
    assert_eq!((all.flags, all.notes.len()), (vec![0, flag::TWO_SIDED], 1));
}
