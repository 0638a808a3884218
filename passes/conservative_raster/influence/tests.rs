use super::PASS;
use crate::shared::hard_scenes::{output, pairs, run_with};
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
