use super::raster;
use crate::shared::camera::Camera;
use crate::shared::hard_scenes::Random;
use crate::view_samples::surface::{Corners, Edges, Seen};
use glam::Vec3;
use shadowgraph_core::shared::NO_TRIANGLE;
use shadowgraph_core::{input, scene};

const NONE: u32 = NO_TRIANGLE;

/// Looks along -z from the origin, with tangent 1 to the top.
fn camera(image: [usize; 2]) -> Camera {
    let camera = scene::Camera {
        name: "test".into(),
        eye: [0.0; 3],
        target: [0.0, 0.0, -1.0],
        up: [0.0, 1.0, 0.0],
        fov_y: std::f32::consts::FRAC_PI_2,
    };
    Camera::from_words(&input::camera_words(&camera, image))
}

fn seen(corners: &[Corners], image: [usize; 2]) -> Seen {
    raster(corners, &camera(image), image, &|_, _| ())
}

/// A rectangle of two triangles across the view.
fn rectangle(low: [f32; 2], high: [f32; 2], depth: f32) -> [Corners; 2] {
    let corner = |x: f32, y: f32| [x, y, -depth];
    let (a, b) = (corner(low[0], low[1]), corner(high[0], low[1]));
    let (c, d) = (corner(high[0], high[1]), corner(low[0], high[1]));
    [[a, b, c], [a, c, d]]
}

#[test]
fn the_pixels_points_and_normals_are_those_counted_by_hand() {
    // The left half of the upper row at depth 2: half widths are 4 and 2 there.
    let corners = rectangle([-4.0, 0.0], [0.0, 2.0], 2.0);
    let seen = seen(&corners, [4, 2]);
    assert_eq!(seen.triangles[2..], [NONE; 6]);
    assert!(seen.triangles[..2].iter().all(|id| *id < 2));
    for (position, x) in seen.positions.iter().zip([-3.0, -1.0]) {
        assert!((Vec3::from(*position) - Vec3::new(x, 1.0, -2.0)).length() < 1e-6, "{position:?}");
    }
    assert_eq!(seen.normals[..3], [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3]]);
}

#[test]
fn the_nearest_wins_in_any_order_from_either_side_and_the_lowest_of_equals() {
    let near = rectangle([-9.0, -9.0], [9.0, 9.0], 2.0);
    let far = rectangle([-9.0, -9.0], [9.0, 9.0], 3.0);
    let turned = near.map(|[a, b, c]| [a, c, b]);
    for scene in [[near, far], [far, near], [far, turned]] {
        let seen = seen(scene.as_flattened(), [5, 5]);
        assert!(seen.positions.iter().all(|p| (p[2] + 2.0).abs() < 1e-6));
        assert!(seen.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]));
    }
    assert!(seen([near, turned].as_flattened(), [5, 5]).triangles.iter().all(|id| *id < 2));
}

#[test]
fn a_floor_under_the_eye_is_seen_over_the_whole_lower_half() {
    // From far behind the eye to far ahead, one below it.
    let corner = |x: f32, z: f32| [x, -1.0, z];
    let floor = [
        [corner(-1e4, 1e4), corner(1e4, 1e4), corner(1e4, -1e4)],
        [corner(-1e4, 1e4), corner(1e4, -1e4), corner(-1e4, -1e4)],
    ];
    let seen = seen(&floor, [64, 64]);
    for (pixel, triangle) in seen.triangles.iter().enumerate() {
        assert_eq!(*triangle != NONE, pixel >= 32 * 64, "row {}", pixel / 64);
    }
    assert!(seen.positions[32 * 64..].iter().all(|p| (p[1] + 1.0).abs() < 1e-6));
    assert!(seen.normals[32 * 64..].iter().all(|n| *n == [0.0, 1.0, 0.0]));
}

#[test]
fn a_box_around_the_eye_fills_the_picture_and_what_is_behind_does_not_show() {
    let p = |x: f32, y: f32, z: f32| [x, y, z];
    let quads = [
        [p(-1.0, -1.0, -1.0), p(1.0, -1.0, -1.0), p(1.0, 1.0, -1.0), p(-1.0, 1.0, -1.0)],
        [p(-1.0, -1.0, 1.0), p(1.0, -1.0, 1.0), p(1.0, 1.0, 1.0), p(-1.0, 1.0, 1.0)],
        [p(-1.0, -1.0, -1.0), p(-1.0, 1.0, -1.0), p(-1.0, 1.0, 1.0), p(-1.0, -1.0, 1.0)],
        [p(1.0, -1.0, -1.0), p(1.0, 1.0, -1.0), p(1.0, 1.0, 1.0), p(1.0, -1.0, 1.0)],
    ];
    let corners: Vec<Corners> = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    // Tangent 2 to the sides: the side walls show left and right of the wall ahead.
    let seen = seen(&corners, [40, 20]);
    assert!(seen.triangles.iter().all(|id| *id != NONE && *id != 2 && *id != 3));
    assert!(seen.triangles[10 * 40] >= 4 && seen.triangles[10 * 40 + 20] < 2);
}

#[test]
fn degenerate_and_edge_on_triangles_are_not_seen_and_an_empty_scene_is_background() {
    let line = [[-1.0, 0.0, -2.0], [0.0, 0.0, -2.0], [1.0, 0.0, -2.0]];
    let edge_on = [[0.0, 0.0, -1.0], [0.0, 0.0, -9.0], [0.0, 5.0, -9.0]];
    let infinite = [[f32::INFINITY, 0.0, -2.0], [0.0, 1.0, -2.0], [0.0, f32::NAN, -2.0]];
    for corners in [vec![], vec![line, edge_on, [[1.0; 3]; 3], infinite]] {
        let seen = seen(&corners, [9, 9]);
        assert!(seen.triangles.iter().all(|id| *id == NONE));
    }
    assert!(seen(&[line], [0, 0]).triangles.is_empty());
}

#[test]
fn a_fine_mesh_has_no_cracks() {
    // A bent sheet over the whole view, in triangles smaller than and larger than pixels.
    for count in [3, 17, 150] {
        let point = |i: usize, j: usize| {
            let (x, y) = (i as f32 / count as f32 * 9.7 - 4.9, j as f32 / count as f32 * 9.7 - 4.8);
            [x, y, -3.0 - (1.7 * x).sin() * (1.3 * y).cos()]
        };
        let mut corners: Vec<Corners> = Vec::new();
        for i in 0..count {
            for j in 0..count {
                let quad = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
                corners.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
            }
        }
        let seen = seen(&corners, [97, 97]);
        assert!(seen.triangles.iter().all(|id| *id != NONE), "{count}");
    }
}

#[test]
fn random_triangles_are_seen_as_every_pixel_tested_against_every_triangle_sees_them() {
    let mut random = Random(11);
    for (size, image) in [(0.3, [37, 33]), (3.0, [40, 50])] {
        let corners: Vec<Corners> = (0..200)
            .map(|_| {
                let middle = random.point().map(|x| 3.0 * x);
                [0; 3].map(|_| {
                    let offset = random.point();
                    [0, 1, 2].map(|axis| middle[axis] + size * offset[axis])
                })
            })
            .collect();
        let camera = camera(image);
        let edges: Vec<_> =
            corners.iter().map(|corners| Edges::new(corners.map(|corner| camera.project(corner.into())))).collect();
        let seen = seen(&corners, image);
        for (pixel, triangle) in seen.triangles.iter().enumerate() {
            let (column, row) = ((pixel % image[0]) as f64 + 0.5, (pixel / image[0]) as f64 + 0.5);
            let mut best = (0.0, NONE);
            for (id, edges) in (0..).zip(&edges) {
                let near = edges.and_then(|edges| edges.nearness(column, row)).unwrap_or(0.0);
                best = if near > best.0 { (near, id) } else { best };
            }
            assert_eq!(*triangle, best.1, "pixel {pixel}");
            if best.1 != NONE {
                // The point lies on the ray at that depth.
                let point = camera.eye + camera.ray(column, row) / best.0;
                assert!((Vec3::from(seen.positions[pixel]).as_dvec3() - point).length() < 1e-5);
            }
        }
    }
}
