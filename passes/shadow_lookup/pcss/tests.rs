use super::PASS;
use super::cpu::{Settings, set_bits, visible};
use super::taps::spiral;
use crate::shared::light_frame::Face;
use crate::shared::shadow_lookup::Map;
use crate::shared::shadow_raster::{CLEAR, draw};
use glam::Vec3;
use shadowgraph_core::param::{Params, Value};

const SIDE: usize = 256;

/// Looks down -y from (0, 4, 0); the window spans u, v in -1..1, far plane at 8.
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

fn settings(light_radius: f32, changes: &[(&'static str, Value)]) -> Settings {
    let mut params = Params::defaults(PASS.params);
    for (name, value) in changes {
        params.0.iter_mut().find(|(known, _)| known == name).unwrap().1 = value.clone();
    }
    Settings::new(&params, light_radius)
}

fn drawn(triangles: &[[[f32; 3]; 3]]) -> Vec<f32> {
    let mut depth = vec![CLEAR; SIDE * SIDE];
    draw(&face(), SIDE, triangles, &vec![1; triangles.len()], &mut depth, |_, _| true);
    depth
}

/// The half plane x >= `edge` at height `y`.
fn half_plane(edge: f32, y: f32) -> [[[f32; 3]; 3]; 2] {
    [[[edge, y, -90.0], [edge, y, 90.0], [90.0, y, -90.0]], [[edge, y, 90.0], [90.0, y, -90.0], [90.0, y, 90.0]]]
}

fn on_floor(depth: &[f32], settings: &Settings, x: f32) -> f32 {
    let faces = [face()];
    visible(Map { faces: &faces, depth, side: SIDE }, settings, Vec3::new(x, 0.0, 0.1), Vec3::Y)
}

#[test]
fn the_penumbra_of_an_edge_is_as_wide_as_light_and_depths_say() {
    // The edge at depth 2 falls on the floor, at depth 4, at x = 1; the penumbra reaches R (4 - 2) / 2 = R to either side.
    let depth = drawn(&half_plane(0.5, 2.0));
    for radius in [0.5, 0.25] {
        let settings = settings(radius, &[]);
        let at = |reach: f32| on_floor(&depth, &settings, 1.0 + reach * radius);
        assert_eq!([at(-1.1), at(1.1)], [1.0, 0.0], "radius {radius}");
        assert!((at(0.0) - 0.5).abs() < 0.06, "{}", at(0.0));
        // A chord at half the radius cuts off (acos(1/2) - sqrt(3)/4) / pi of a disc.
        assert!((at(-0.5) - 0.804).abs() < 0.06 && (at(0.5) - 0.196).abs() < 0.06, "{} {}", at(-0.5), at(0.5));
    }
}

#[test]
fn contacts_are_hard_and_a_point_light_is_a_single_comparison() {
    let (near, apart) = (drawn(&half_plane(0.96, 0.1)), drawn(&half_plane(0.5, 2.0)));
    let half_light = settings(0.5, &[]);
    // The edge at depth 3.9 falls at x = 0.96 * 4 / 3.9; the penumbra reaches 0.013.
    let edge = 0.96 * 4.0 / 3.9;
    assert_eq!(on_floor(&near, &half_light, edge - 0.06), 1.0);
    assert_eq!(on_floor(&near, &half_light, edge + 0.06), 0.0);
    let point = settings(0.0, &[]);
    assert_eq!([on_floor(&apart, &point, 0.98), on_floor(&apart, &point, 1.02)], [1.0, 0.0]);
}

#[test]
fn a_narrow_search_misses_what_a_wide_one_finds_and_widths_are_cut() {
    let depth = drawn(&half_plane(0.5, 2.0));
    let narrow = settings(0.5, &[("nearest_blocker", Value::F32(0.9))]);
    assert_eq!(on_floor(&depth, &narrow, 0.7), 1.0);
    assert!(on_floor(&depth, &settings(0.5, &[]), 0.7) < 1.0);
    // A radius of 0.02 of the side is 0.04 in u, 0.16 on the floor.
    let cut = settings(0.5, &[("largest_width", Value::F32(0.02))]);
    assert_eq!([on_floor(&depth, &cut, 0.8), on_floor(&depth, &cut, 1.2)], [1.0, 0.0]);
}

#[test]
fn planes_do_not_shadow_themselves_however_wide_the_search() {
    for normal in [Vec3::Y, Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.5, 0.6, 0.62).normalize()] {
        let (e1, e2) = (normal.any_orthonormal_pair().0 * 30.0, normal.any_orthonormal_pair().1 * 30.0);
        let depth = drawn(&[[-e1 - e2, 3.0 * e1 - e2, 3.0 * e2 - e1].map(|p| p.to_array())]);
        let faces = [face()];
        let map = Map { faces: &faces, depth: &depth, side: SIDE };
        let share = |settings: &Settings| {
            let mut shares = Vec::new();
            for k in 0..900 {
                let (u, v) = ((k % 30) as f32 / 20.0 - 0.73, (k / 30) as f32 / 20.0 - 0.73);
                let ray = Vec3::new(u, -1.0, v);
                let along = normal.dot(-faces[0].origin) / normal.dot(ray);
                if along > 0.1 && along < 7.5 {
                    shares.push(visible(map, settings, faces[0].origin + ray * along, normal));
                }
            }
            shares.iter().sum::<f32>() / shares.len() as f32
        };
        assert_eq!(share(&settings(0.5, &[])), 1.0, "{normal}");
        if normal != Vec3::Y {
            assert!(share(&settings(0.5, &[("bias_slope", Value::F32(0.0))])) < 0.99, "{normal}");
        }
    }
}

#[test]
fn bits_are_the_share_rounded() {
    let bits = |light_count: usize, visible: f32| {
        let mut mask = vec![7; light_count.div_ceil(32)];
        set_bits(&mut mask, light_count, visible);
        mask
    };
    assert_eq!([bits(1, 0.49), bits(1, 0.51)], [[1], [0]]);
    assert_eq!([bits(4, 0.5), bits(4, 0.0), bits(4, 0.95)], [[3], [15], [0]]);
    assert_eq!(bits(40, 0.1), [u32::MAX, 0b1111]);
    assert_eq!(bits(64, 0.0), [u32::MAX; 2]);
}

#[test]
fn taps_fill_the_disc_evenly() {
    for count in [1, 32, 64, 256] {
        let taps = spiral(count);
        assert!(taps.len() == count && taps.iter().all(|[x, y]| x * x + y * y < 1.0));
        if count > 1 {
            // The mean square radius of a disc is a half, whichever half plane the taps are counted in about half are there.
            let square = taps.iter().map(|[x, y]| x * x + y * y).sum::<f32>() / count as f32;
            assert!((square - 0.5).abs() < 1e-3);
            for angle in [0.0f32, 1.0, 2.0, 3.0] {
                let side = taps.iter().filter(|[x, y]| x * angle.cos() + y * angle.sin() > 0.0).count();
                assert!(side.abs_diff(count / 2) <= count / 16 + 1, "{side} of {count}");
            }
        }
    }
}
