use super::*;

/// A triangle in the plane y = 1, above the origin.
const ROOF: Corners = [[-1.0, 1.0, -1.0], [1.0, 1.0, -1.0], [0.0, 1.0, 1.0]];
const ABOVE: [f32; 3] = [0.0, 2.0, 0.0];

fn turned(corners: &Corners) -> Corners {
    [corners[0], corners[2], corners[1]]
}

fn both_windings(position: [f32; 3], caster: &Corners, light: [f32; 3]) -> bool {
    let answer = blocks(position, None, caster, light);
    for corners in [turned(caster), [caster[1], caster[2], caster[0]]] {
        assert_eq!(blocks(position, None, &corners, light), answer, "{position:?} {corners:?}");
    }
    answer
}

#[test]
fn a_roof_shades_what_is_below_it() {
    assert!(both_windings([0.0, 0.0, 0.0], &ROOF, ABOVE));
    assert!(!both_windings([5.0, 0.0, 0.0], &ROOF, ABOVE));
    // Above the light, and between roof and light.
    assert!(!both_windings([0.0, 3.0, 0.0], &ROOF, ABOVE));
    assert!(!both_windings([0.0, 1.5, 0.0], &ROOF, ABOVE));
}

#[test]
fn a_triangle_behind_the_light_or_behind_the_sample_does_not_block() {
    // The line through P and S meets the roof, the segment does not.
    assert!(!both_windings([0.0, 3.0, 0.0], &ROOF, [0.0, 2.0, 0.0]));
    assert!(!both_windings([0.0, 2.0, 0.0], &ROOF, [0.0, 3.0, 0.0]));
    assert!(!both_windings([0.0, 0.0, 0.0], &ROOF, [0.0, 0.5, 0.0]));
    assert!(!both_windings([0.0, 0.5, 0.0], &ROOF, [0.0, 0.0, 0.0]));
    // P and S at one point.
    assert!(!both_windings(ABOVE, &ROOF, ABOVE));
}

#[test]
fn a_light_in_the_plane_is_blocked_only_through_the_triangle() {
    assert!(both_windings([0.0, 0.0, 0.0], &ROOF, [0.0, 1.0, 0.0]));
    assert!(both_windings([0.0, 0.0, 0.0], &ROOF, [1.0, 1.0, -1.0]));
    assert!(!both_windings([0.0, 0.0, 0.0], &ROOF, [2.0, 1.0, -1.0]));
}

#[test]
fn edge_on_and_degenerate_triangles_never_block() {
    // P in the plane of the triangle.
    assert!(!both_windings([-3.0, 1.0, 0.0], &ROOF, [3.0, 1.0, 0.0]));
    assert!(!both_windings([-3.0, 1.0, 0.0], &ROOF, ABOVE));
    // A wall in the plane x = 0, seen along it.
    let wall = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
    assert!(!both_windings([0.0, 0.0, 2.0], &wall, [0.0, 3.0, -2.0]));
    let point = [[0.0, 1.0, 0.0]; 3];
    let segment = [[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.5, 1.0, 0.0]];
    assert!(!both_windings([0.0, 0.0, 0.0], &point, ABOVE));
    assert!(!both_windings([0.0, 0.0, 0.0], &segment, ABOVE));
}

#[test]
fn no_light_leaks_through_a_shared_edge_or_corner() {
    // A fan of four triangles around (0.3, 1, 0.1), whose bits are not round; P straight below edges and corner.
    let hub = [0.3, 1.0, 0.1];
    let rim = [[-1.0, 1.25, -1.0], [1.0, 1.5, -1.1], [1.2, 1.0, 1.3], [-0.9, 0.75, 1.0]];
    let fan: Vec<Corners> = (0..4).map(|k| [hub, rim[k], rim[(k + 1) % 4]]).collect();
    let light = [0.3, 4.0, 0.1];
    let blockers = |p: [f32; 3]| fan.iter().filter(|corners| both_windings(p, corners, light)).count();
    assert_eq!(blockers([0.3, 0.0, 0.1]), 4);
    for (k, end) in rim.iter().enumerate() {
        for step in 1..64 {
            let t = step as f32 / 64.0;
            let along = |axis: usize| hub[axis] + t * (end[axis] - hub[axis]);
            assert!(blockers([along(0), 0.0, along(2)]) >= 1, "edge {k} at {t}");
        }
    }
    // Exactly below the edge from (0, 1, 0) to (1, 1, 0) both sides answer.
    let north = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
    let south = [[0.0, 1.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.0, 0.0]];
    for caster in [north, south] {
        assert!(both_windings([0.5, 0.0, 0.0], &caster, [0.5, 2.0, 0.0]));
    }
}

#[test]
fn the_smallest_step_off_an_edge_is_seen() {
    let north = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
    let step = f32::from_bits(1);
    assert!(both_windings([0.25, 0.0, step], &north, [0.25, 2.0, 0.0]));
    assert!(!both_windings([0.25, 0.0, -step], &north, [0.25, 2.0, 0.0]));
}

#[test]
fn a_triangle_at_or_below_the_own_plane_cannot_block() {
    let floor = [[-4.0, 0.0, -4.0], [-4.0, 0.0, 4.0], [4.0, 0.0, 0.0]];
    // Rounding has put P a little below the floor, and a coplanar neighbour seems to cover it.
    let position = [0.0, -1e-6, 0.0];
    let coplanar = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    assert!(blocks(position, None, &coplanar, ABOVE));
    assert!(!blocks(position, Some(&floor), &coplanar, ABOVE));
    assert!(!blocks(position, Some(&turned(&floor)), &coplanar, ABOVE));
    // One corner above is enough.
    let mut lifted = coplanar;
    lifted[2][1] = 1e-9;
    assert!(blocks(position, Some(&floor), &lifted, ABOVE));
    // The light in the own plane, or a degenerate own triangle: the rule says nothing.
    assert!(OwnPlane::new(&floor, [9.0, 0.0, 0.0]).admits(&coplanar));
    assert!(OwnPlane::new(&[[0.0; 3]; 3], ABOVE).admits(&coplanar));
    assert!(blocks(position, Some(&[[0.0; 3]; 3]), &coplanar, ABOVE));
}

#[test]
fn sides_are_exact_where_f64_rounds() {
    // Far out, one unit in the last place of f32 off a slanted plane.
    let corners = [[1e7, 0.0, 1e7], [0.0, 1e7, 1e7], [1e7, 1e7, 0.0]];
    let inside = [6e6, 6e6, 8e6];
    assert_eq!(side(&corners, inside), 0);
    let up = [6e6, 6e6, f32::from_bits(8e6_f32.to_bits() + 1)];
    let down = [6e6, 6e6, f32::from_bits(8e6_f32.to_bits() - 1)];
    assert_eq!(side(&corners, up), -side(&corners, down));
    assert_ne!(side(&corners, up), 0);
}
