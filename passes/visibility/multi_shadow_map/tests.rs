use super::cpu::{Scene, answer, check_bytes};
use super::{PASS, at_once, ranges};
use crate::shared::light_fit;
use crate::shared::light_frame::Face;
use crate::shared::shadow_lookup::{Lookup, Map, visible};
use crate::shared::shadow_raster::{CLEAR, draw};
use glam::Vec3;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::record::{Command, DeviceLimits, GpuCx};
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT};

const LOOKUP: Lookup = Lookup { bias_constant: 0.0, bias_slope: 1.0, normal_offset: 0.0, kernel: 1 };

/// A view-sample at each of a grid of places on the floor y = 0.
fn floor(count: usize) -> Vec<[f32; 3]> {
    let at = |k: usize| 4.0 * (k as f32 + 0.5) / count as f32 - 2.0;
    (0..count * count).map(|k| [at(k % count), 0.0, at(k / count)]).collect()
}

/// A board of 2 x 2 at height 1 above the middle of the floor.
const BOARD: [[[f32; 3]; 3]; 2] =
    [[[-1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]], [[-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, 1.0]]];

/// A frame fitted to `position` from the mean of `lights`.
fn frame(position: &[[f32; 3]], states: &[u32], lights: &[[f32; 3]]) -> Face {
    let origin = light_fit::origin(lights);
    let face = light_fit::look(origin, light_fit::middle(&light_fit::direction_bounds(origin, position, states)));
    light_fit::fit(face, &light_fit::window_bounds(&face, position, states).0)
}

fn masks(lights: &[[f32; 3]], position: &[[f32; 3]], states: &[u32], side: usize, at_once: usize) -> Vec<u32> {
    let face = frame(position, states, lights);
    let normal = vec![[0.0, 1.0, 0.0]; position.len()];
    let scene = Scene {
        triangles: &BOARD,
        caster_state: &[1, 1],
        light_samples: lights,
        faces: &[face],
        position,
        normal: &normal,
        sample_state: states,
    };
    let (masks, behind) = answer(scene, side, at_once, LOOKUP, &|_, _| {});
    assert_eq!(behind, 0);
    masks
}

#[test]
fn each_light_sample_casts_the_board_where_it_stands() {
    // The board's edges x = -1 and 1 fall on the floor at x = -1.5 - s / 2 and 1.5 - s / 2 from a light at (s, 3, 0).
    let lights: Vec<[f32; 3]> = (0..40).map(|k| [k as f32 / 20.0 - 1.0, 3.0, 0.0]).collect();
    let position = floor(31);
    let found = masks(&lights, &position, &vec![KEPT; position.len()], 256, 8);
    for (at, mask) in position.iter().zip(found.chunks_exact(2)) {
        for (sample, light) in lights.iter().enumerate() {
            let inside = (1.5 - (at[0] + light[0] / 2.0).abs()).min(1.5 - at[2].abs());
            let is_blocked = mask[sample / 32] >> (sample % 32) & 1 == 1;
            // A texel is 4 / 256 wide on the floor.
            assert!(inside.abs() < 0.02 || is_blocked == (inside > 0.0), "{at:?} from {light:?}");
        }
        assert_eq!(mask[1] >> 8, 0, "bits past the light samples");
    }
}

#[test]
fn states_are_kept_and_ranges_change_nothing() {
    let lights: Vec<[f32; 3]> = (0..70).map(|k| [0.01 * k as f32, 3.0, 0.02 * (k % 7) as f32]).collect();
    let position = floor(9);
    let states: Vec<u32> = (0..81).map(|row| [KEPT, FACING_AWAY, KEPT, BACKGROUND][row % 4]).collect();
    let one = masks(&lights, &position, &states, 64, 1);
    for at_once in [5, 8, 32] {
        assert_eq!(masks(&lights, &position, &states, 64, at_once), one, "{at_once} at once");
    }
    for (state, mask) in states.iter().zip(one.chunks_exact(3)) {
        match *state {
            BACKGROUND => assert_eq!(mask, [0; 3]),
            FACING_AWAY => assert_eq!(mask, [u32::MAX; 3]),
            _ => assert_eq!(mask[2] >> 6, 0),
        }
    }
}

#[test]
fn one_light_sample_is_the_single_shadow_map_bit_for_bit() {
    let lights = [[0.3, 3.0, -0.2]];
    let position = floor(40);
    let states = vec![KEPT; position.len()];
    let faces = [frame(&position, &states, &lights)];
    let side = 48;
    let mut depth = vec![CLEAR; side * side];
    draw(&faces[0], side, &BOARD, &[1, 1], &mut depth, |_, _| true);
    let map = Map { faces: &faces, depth: &depth, side };
    let single: Vec<u32> =
        position.iter().map(|at| u32::from(visible(map, LOOKUP, Vec3::from(*at), Vec3::Y) < 0.5)).collect();
    assert!(single.contains(&1) && single.contains(&0));
    assert_eq!(masks(&lights, &position, &states, side, 8), single);
}

#[test]
fn ranges_hold_every_light_sample_once_and_cross_no_word() {
    for (count, at_once) in [(0, 8), (1, 8), (33, 8), (70, 5), (256, 32), (100, 32)] {
        let all: Vec<_> = ranges(count, at_once).collect();
        assert!(all.iter().cloned().flatten().eq(0..count));
        assert!(all.iter().all(|range| range.len() <= at_once && range.start / 32 == (range.end - 1) / 32));
    }
}

#[test]
fn memory_does_not_grow_with_the_light_samples() {
    let recipe = |light_count: usize| {
        let mut params = Params::defaults(PASS.params);
        assert_eq!(params.0[1].0, "memory");
        params.0[1].1 = Value::U32(35);
        let shapes = vec![
            ("triangles", vec![5, 3, 3]),
            ("caster_state", vec![5]),
            ("light_samples", vec![light_count, 3]),
            ("light_frame", vec![1, 20]),
            ("position", vec![100, 3]),
            ("normal", vec![100, 3]),
            ("sample_state", vec![100]),
            ("mask", vec![100, light_count.div_ceil(32)]),
        ];
        let limits = DeviceLimits { storage_binding_bytes: 1 << 27, texture_side: 8192, storage_buffers: 8 };
        let mut cx = GpuCx::new(&PASS, &params, [10, 10], shapes, limits);
        super::gpu::record(&mut cx).unwrap();
        cx.finish()
    };
    let (scratch, commands) = recipe(4096);
    let maps = scratch.iter().find(|scratch| scratch.label == "maps").unwrap();
    assert_eq!(maps.shape, [8, 1024, 1024]);
    let draws = commands.iter().filter(|command| matches!(command, Command::Draw(_))).count();
    let dispatches = commands.iter().filter(|command| matches!(command, Command::Dispatch(_))).count();
    assert_eq!((draws, dispatches), (4096, 3 + 512));
    assert_eq!([at_once(&Params::defaults(PASS.params), 1), at_once(&Params::defaults(PASS.params), 6)], [32, 5]);
    assert_eq!(recipe(1).0.iter().find(|scratch| scratch.label == "maps").unwrap().shape, [1, 1024, 1024]);
}

#[test]
fn maps_that_do_not_fit_are_refused_with_what_would() {
    assert!(check_bytes(1, 1024, 32).is_ok() && check_bytes(2, 16_384, 1).is_ok());
    let problem = check_bytes(6, 16_384, 1).unwrap_err().to_string();
    assert!(
        problem.contains("at most 2147483648 bytes") && problem.contains("set `size` to 9459 or less"),
        "{problem}"
    );
    check_bytes(6, 9459, 1).unwrap();
    let problem = check_bytes(1, 8192, 32).unwrap_err().to_string();
    assert!(
        problem.contains("found 8589934592 bytes") && problem.contains("set `memory` to 2048 or less"),
        "{problem}"
    );
}
