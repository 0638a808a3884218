//! Both passes on the same view-samples.

use super::place::Samples;
use super::{Lists, atomic_counters, sort};
use crate::shared::light_frame::{Face, cell_of};
use glam::Vec3;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_CELL};

type Build = fn(&Samples) -> Lists;
pub const BUILDS: [(&str, Build); 2] = [("atomic_counters", atomic_counters::cpu::count), ("sort", sort::cpu::sort)];

/// Looks down -y from (0, 10, 0) at the square -1..1 of the plane y = 0.
pub fn face() -> Face {
    Face {
        origin: Vec3::new(0.0, 10.0, 0.0),
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Z,
        axis_z: -Vec3::Y,
        window_low: [-0.1, -0.1],
        window_size: [0.2, 0.2],
        near: 9.0,
        far: 10.0,
    }
}

/// Six faces about the origin, each a right angle wide.
fn cube() -> Vec<Face> {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let one = |axis: usize, sign: f32| Face {
        origin: Vec3::ZERO,
        axis_x: axes[(axis + 1) % 3],
        axis_y: axes[(axis + 2) % 3],
        axis_z: sign * axes[axis],
        window_low: [-1.0, -1.0],
        window_size: [2.0, 2.0],
        ..face()
    };
    (0..3).flat_map(|axis| [one(axis, 1.0), one(axis, -1.0)]).collect()
}

/// Numbers in 0..1 that look random.
fn noise(seed: &mut u32) -> f32 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*seed >> 8) as f32 / (1 << 24) as f32
}

#[test]
fn five_view_samples_counted_by_hand() {
    // Two texels a side, each one unit wide on the plane y = 0.
    let positions =
        [[-0.5, 0.0, -0.5], [0.5, 0.0, -0.5], [-0.4, 1.0, -0.6], [0.5, 0.0, 0.5], [0.0, 0.0, 0.0], [0.5, 0.0, 0.5]];
    let states = [KEPT, KEPT, KEPT, KEPT, BACKGROUND, FACING_AWAY];
    for (name, build) in BUILDS {
        let lists = build(&Samples { positions: &positions, states: &states, faces: vec![face()], side: 2 });
        assert_eq!(lists.cell, [0, 1, 0, 3, NO_CELL, NO_CELL], "{name}");
        assert_eq!(lists.length, [2, 1, 0, 1], "{name}");
        assert_eq!(lists.far, [10.0, 10.0, 0.0, 10.0], "{name}");
        assert_eq!(lists.slot[0] + lists.slot[2], 1, "{name}");
        assert_eq!((lists.slot[1], lists.slot[3], lists.unplaced), (0, 0, 0), "{name}");
    }
}

#[test]
fn a_view_sample_outside_the_window_is_in_its_border() {
    let positions = [[-50.0, 0.0, 0.0], [50.0, 0.0, 90.0]];
    for (name, build) in BUILDS {
        let lists = build(&Samples { positions: &positions, states: &[KEPT; 2], faces: vec![face()], side: 4 });
        assert_eq!(lists.cell, [8, 15], "{name}");
    }
}

#[test]
fn what_no_face_sees_is_counted_and_in_no_list() {
    let positions = [[0.0, 11.0, 0.0], [0.0, 10.0, 5.0], [0.0, 10.0, 0.0], [f32::NAN; 3], [0.0, 0.0, 0.0]];
    for (name, build) in BUILDS {
        let lists = build(&Samples { positions: &positions, states: &[KEPT; 5], faces: vec![face()], side: 1 });
        assert_eq!(lists.cell, [NO_CELL, NO_CELL, NO_CELL, NO_CELL, 0], "{name}");
        assert_eq!((lists.unplaced, lists.length.as_slice()), (4, [1].as_slice()), "{name}");
    }
}

#[test]
fn every_kept_view_sample_is_listed_once() {
    let mut seed = 1;
    for count in [0, 1, 63, 64, 65, 257, 40_000] {
        let positions: Vec<[f32; 3]> = (0..count).map(|_| [(); 3].map(|()| 2.0 * noise(&mut seed) - 1.0)).collect();
        let states: Vec<u32> = (0..count).map(|_| (noise(&mut seed) * 3.0) as u32).collect();
        let kept = states.iter().filter(|state| **state == KEPT).count();
        for (faces, side) in [(vec![face()], 1), (vec![face()], 37), (cube(), 16)] {
            let samples = Samples { positions: &positions, states: &states, faces, side };
            for (name, build) in BUILDS {
                let lists = build(&samples);
                check(&samples, &lists, kept, &format!("{name}, {count} view-samples, side {side}"));
            }
        }
    }
}

fn check(samples: &Samples, lists: &Lists, kept: usize, text: &str) {
    assert_eq!(lists.length.iter().sum::<u32>() as usize, kept, "{text}");
    let mut seen: Vec<Vec<bool>> = lists.length.iter().map(|length| vec![false; *length as usize]).collect();
    let mut far = vec![0.0f32; lists.far.len()];
    for index in 0..samples.positions.len() {
        let placed = cell_of(&samples.faces, samples.positions[index].into(), samples.side);
        let Some((cell, depth)) = placed.filter(|_| samples.states[index] == KEPT) else {
            assert_eq!(lists.cell[index], NO_CELL, "{text}");
            continue;
        };
        assert_eq!(lists.cell[index] as usize, cell, "{text}");
        let taken = &mut seen[cell][lists.slot[index] as usize];
        assert!(!std::mem::replace(taken, true), "{text}: a slot is given twice");
        far[cell] = far[cell].max(depth);
    }
    assert!(far == lists.far, "{text}");
}
