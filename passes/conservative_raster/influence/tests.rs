use super::PASS;
use crate::shared::hard_scenes::{Case, output, pairs, random, run_with};
use crate::shared::soft_scenes::{LIGHTS, Soft, soft};
use glam::Vec3;
use shadowgraph_core::param::{Params, Value};
use std::collections::HashSet;

fn params(bound: &str, sides: u32, cut: bool) -> Params {
    Params(vec![("sides", Value::U32(sides)), ("bound", Value::Word(bound.into())), ("cut", Value::Bool(cut))])
}

/// Pairs that the pass finds in `soft` when it is told of `light`.
fn found(soft: &Soft, light: &[[f32; 3]], params: &Params) -> HashSet<(u32, u32)> {
    let (outputs, counts) = run_with(&PASS, params, &soft.inputs_lit_by(light)).unwrap();
    let pairs = pairs(&outputs);
    assert_eq!(counts[0] as usize, pairs.len());
    pairs
}

fn needed(soft: &Soft) -> HashSet<(u32, u32)> {
    soft.needed(output(&soft.inputs(), "cell").as_u32())
}

#[test]
fn every_pair_that_matters_is_there_for_every_light_and_bound() {
    let kinds = [("sphere", 4), ("sphere", 6), ("sphere", 8), ("ellipsoid", 4), ("ellipsoid", 6), ("quad", 4)];
    let mut tightness = Vec::new();
    let mut rounds = 0;
    for (index, light) in LIGHTS.iter().enumerate() {
        let mut sums = [[0usize; 2]; 6];
        for seed in 0..60 {
            let soft = soft(1000 * index as u64 + seed, light, 12 + 10 * (seed % 3) as usize, 80);
            let needed = needed(&soft);
            let length = soft.case.inputs();
            let length = output(&length, "list_length").as_u32();
            for (sums, (bound, sides)) in sums.iter_mut().zip(kinds) {
                let found = found(&soft, &soft.light, &params(bound, sides, seed % 4 != 0));
                for pair in &needed {
                    assert!(found.contains(pair), "{light} {seed} {bound} {sides}: {pair:?} is missing");
                }
                assert!(
                    found
                        .iter()
                        .all(|(cell, caster)| { length[*cell as usize] > 0 && soft.case.casts[*caster as usize] != 0 })
                );
                (sums[0], sums[1]) = (sums[0] + found.len(), sums[1] + needed.len());
                rounds += 1;
            }
        }
        for ((bound, sides), [found, needed]) in kinds.into_iter().zip(sums) {
            tightness.push((light, bound, sides, found as f64 / needed as f64));
        }
    }
    for (light, bound, sides, ratio) in &tightness {
        println!("{light:>10} {bound:>10} {sides}: {ratio:.2} pairs found for each needed");
    }
    assert!(rounds > 2000 && tightness.iter().all(|row| row.3 >= 1.0 && row.3 < 20.0));
}

#[test]
fn told_of_a_smaller_light_it_misses_pairs() {
    let mut missed = 0;
    for seed in 0..40 {
        let soft = soft(seed, "sphere", 20, 80);
        let centre = Vec3::from(soft.case.light);
        let shrunk: Vec<[f32; 3]> =
            soft.light.iter().map(|s| (centre + 0.8 * (Vec3::from(*s) - centre)).to_array()).collect();
        let found = found(&soft, &shrunk, &params("ellipsoid", 8, true));
        missed += needed(&soft).difference(&found).count();
    }
    assert!(missed > 0);
}

/// A roof at height 1 with corners at -1/4 and 1/4, under a square light at height 2 of half side `half`, over a floor of
/// 4 x 4 cells of side 1 with a view-sample in the middle of each. Doubled onto the floor, the roof has corners at -1/2 and
/// 1/2, and the light dilates it by `half`.
fn roof(half: f32) -> Soft {
    let mut case: Case = random(0, 1, 0);
    case.triangles = vec![[[-0.25, 1.0, -0.25], [0.25, 1.0, -0.25], [-0.25, 1.0, 0.25]]];
    case.casts = vec![1];
    case.light = [0.0, 2.0, 0.0];
    case.position = (0..16).map(|at| [(at % 4) as f32 - 1.5, 0.0, (at / 4) as f32 - 1.5]).collect();
    case.triangle = vec![7; 16];
    case.state = vec![1; 16];
    case.side = 4;
    case.look(false, false);
    let face = &mut case.faces[0];
    (face.axis_x, face.axis_y, face.axis_z) = (Vec3::X, Vec3::Z, Vec3::NEG_Y);
    (face.window_low, face.window_size, face.far) = ([-1.0; 2], [2.0; 2], 2.0);
    let light = [[-half, 2.0, -half], [half, 2.0, -half], [half, 2.0, half], [-half, 2.0, half]];
    Soft { case, light: light.to_vec() }
}

fn cells(soft: &Soft, params: &Params) -> Vec<u32> {
    let mut cells: Vec<u32> = found(soft, &soft.light, params).into_iter().map(|(cell, _)| cell).collect();
    cells.sort_unstable();
    cells
}

#[test]
fn a_square_light_dilates_a_small_roof() {
    let four = params("ellipsoid", 4, true);
    assert_eq!(cells(&roof(0.4), &four), [5, 6, 9, 10]);
    // Up to 1.3 along both axes, cut by x + z = 1.6: all cells but the last, which begins at (1, 1).
    assert_eq!(cells(&roof(0.8), &four), (0..15).collect::<Vec<u32>>());
    assert_eq!(cells(&roof(0.8), &params("quad", 4, true)), (0..16).collect::<Vec<u32>>());
}

#[test]
fn cells_before_the_roof_and_empty_cells_get_no_pair() {
    let mut soft = roof(0.4);
    // Lift the view-sample of cell 5 above the roof; take away that of cell 10.
    soft.case.position[5] = [-0.1, 1.5, -0.1];
    soft.case.state[10] = 0;
    assert_eq!(cells(&soft, &params("ellipsoid", 4, true)), [6, 9]);
}

#[test]
fn a_roof_that_touches_the_light_goes_everywhere() {
    let mut soft = roof(0.4);
    soft.case.triangles[0] = [[-0.1, 2.0, -0.1], [0.1, 1.5, -0.1], [-0.1, 1.5, 0.1]];
    assert_eq!(cells(&soft, &params("ellipsoid", 6, true)).len(), 16);
}

#[test]
fn the_light_side_of_a_slanted_roof_is_cut_off() {
    // A roof at height 1 + x / 2; the view-samples of the two left columns are lifted to height 5/4, and all of their cells at that
    // height is above it.
    let mut soft = roof(0.3);
    soft.case.triangles[0] = [[-1.0, 0.5, -1.0], [-1.0, 0.5, 1.0], [1.0, 1.5, 0.0]];
    for position in soft.case.position.iter_mut().filter(|position| position[0] < 0.0) {
        *position = [0.375 * position[0], 1.25, 0.375 * position[2]];
    }
    // Rows at the border reach so far that rounding may take their view-samples anywhere along them.
    let is_right = |cell: &u32| cell % 4 >= 2 || [0, 3].contains(&(cell / 4));
    let cut = cells(&soft, &params("quad", 4, true));
    assert!(!cut.is_empty() && cut.iter().all(is_right), "{cut:?}");
    assert!(!cells(&soft, &params("quad", 4, false)).iter().all(is_right));
}

#[test]
fn both_kernels_state_one_slack() {
    // The second reads regions that the first made and widens their lines by the same.
    let kernels = [include_str!("../../shared/influence_walk.wgsl"), include_str!("../../shared/face_light.wgsl")];
    let [one, other] = kernels.map(|text| text.lines().find(|line| line.starts_with("const SLACK: f32 = ")));
    assert!(one.is_some() && one == other, "{one:?}, {other:?}");
}
