use super::*;
use crate::shared::shadow_map::{depth_from_linear, linear_from_depth};
use glam::{DVec3, Vec3};

/// Looks down -y from (0, 4, 0); the window spans u, v in -1..1; columns grow with x, rows with z.
fn face() -> Face {
    Face {
        origin: Vec3::new(0.0, 4.0, 0.0),
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Z,
        axis_z: -Vec3::Y,
        window_low: [-1.0, -1.0],
        window_size: [2.0, 2.0],
        near: 1.0,
        far: 8.0,
    }
}

fn drawn(triangles: &[[[f32; 3]; 3]], side: usize) -> Vec<f32> {
    let mut layer = vec![CLEAR; side * side];
    draw(&face(), side, triangles, &vec![1; triangles.len()], &mut layer, |_, _| true);
    layer
}

#[test]
fn a_half_plane_at_known_depth_covers_the_texels_counted_by_hand() {
    // At y = 2, depth 2, x from 0.5 on: u from 0.25 on; of 8 columns with centres at -7/8, -5/8, .. those right of 0.25.
    let triangles = [
        [[0.5, 2.0, -9.0], [0.5, 2.0, 9.0], [90.0, 2.0, -9.0]],
        [[0.5, 2.0, 9.0], [90.0, 2.0, -9.0], [90.0, 2.0, 9.0]],
    ];
    let layer = drawn(&triangles, 8);
    for (texel, depth) in layer.iter().enumerate() {
        let expected = if texel % 8 >= 5 { depth_from_linear(2.0, 8.0) } else { CLEAR };
        assert!((depth - expected).abs() < 1e-6, "texel {texel} holds {depth}");
    }
}

#[test]
fn what_is_behind_or_past_far_or_does_not_cast_or_falls_on_no_valid_face_is_not_drawn() {
    let at = |y: f32| [[-90.0, y, -90.0], [90.0, y, -90.0], [0.0, y, 200.0]];
    assert!(drawn(&[at(5.0), at(-4.1)], 8).iter().all(|depth| *depth == CLEAR));
    assert!(drawn(&[at(-3.9)], 8).iter().all(|depth| *depth < CLEAR));
    let mut layer = vec![CLEAR; 64];
    draw(&face(), 8, &[at(0.0)], &[0], &mut layer, |_, _| true);
    draw(&Face { valid: false, ..face() }, 8, &[at(0.0)], &[1], &mut layer, |_, _| true);
    assert!(layer.iter().all(|depth| *depth == CLEAR));
}

/// Distance along the axis at which the ray through a texel's centre meets a triangle, and how far inside it that is.
fn meet(triangle: &[[f32; 3]; 3], column: usize, row: usize, side: usize) -> Option<(f64, f64)> {
    let centre = |k: usize| -1.0 + (2 * k + 1) as f64 / side as f64;
    let direction = DVec3::new(centre(column), -1.0, centre(row));
    let [a, b, c] = triangle.map(|p| DVec3::from(p.map(f64::from)) - DVec3::new(0.0, 4.0, 0.0));
    let (normal, e1, e2) = ((b - a).cross(c - a), b - a, c - a);
    let along = normal.dot(a) / normal.dot(direction);
    let point = direction * along - a;
    let (v, w) = (normal.dot(point.cross(e2)), normal.dot(e1.cross(point)));
    let (v, w) = (v / normal.length_squared(), w / normal.length_squared());
    (along > 0.0).then_some((along, v.min(w).min(1.0 - v - w)))
}

#[test]
fn random_triangles_hold_the_nearest_hit_of_the_ray_through_each_centre() {
    let mut state = 7u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    };
    // Large ones cross the light's plane y = 4 and lie behind it; 100 rows make two bands.
    let triangles: Vec<_> = (0..60)
        .map(|index| {
            let size = if index % 4 == 0 { 6.0 } else { 1.0 };
            let centre = [2.0 * random(), 1.0 + 2.0 * random(), 2.0 * random()];
            [0; 3].map(|_| [0, 1, 2].map(|k| centre[k] + size * random()))
        })
        .collect();
    let side = 100;
    let layer = drawn(&triangles, side);
    let mut covered = 0;
    for (texel, depth) in layer.iter().enumerate() {
        let hits: Vec<_> = triangles.iter().filter_map(|t| meet(t, texel % side, texel / side, side)).collect();
        let is_seen = |w: f64| w >= f64::from(8.0 * NEAR_SHARE) && w <= 8.0;
        if hits.iter().any(|(_, inside)| inside.abs() < 1e-9) {
            continue;
        }
        let nearest = hits.iter().filter(|(w, inside)| *inside > 0.0 && is_seen(*w)).map(|(w, _)| *w);
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        let found = f64::from(linear_from_depth(*depth, 8.0));
        covered += usize::from(nearest.is_finite());
        assert!(found == nearest || (found - nearest).abs() < 1e-3 * nearest, "texel {texel}: {found}, not {nearest}");
    }
    assert!(covered > side * side / 4 && covered < side * side, "{covered}");
}
