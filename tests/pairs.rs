//! Pairs of area lights on random scenes: what a recipe finds holds every (cell, caster) pair in which brute force finds a blocked light
//! sample, and little that the CPU function does not find.

use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph_core::array::Array;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_passes::conservative_raster::influence::PASS;
use shadowgraph_passes::shared::hard_scenes::{output, pairs, run_with};
use shadowgraph_passes::shared::soft_scenes::{LIGHTS, Soft, soft};
use shadowgraph_wgpu::Session;
use std::collections::HashSet;

const KINDS: [(&str, u32); 4] = [("sphere", 4), ("ellipsoid", 6), ("sphere", 8), ("quad", 4)];
const SEEDS: u64 = 16;
/// More pairs than the CPU function finds, at most. Many random casters pass through a point light but for rounding: where f32 cannot
/// tell them apart from it, their regions are whole faces.
const SHARE: f64 = 1.25;

/// A trial a light, and the control.
pub fn trials() -> Vec<Trial> {
    let trial = |(index, light): (usize, &&'static str)| {
        let light: &'static str = light;
        gpu::trial(format!("pairs/influence/{light}"), move |session| check(session, index as u64, light))
    };
    let mut trials: Vec<Trial> = LIGHTS.iter().enumerate().map(trial).collect();
    trials.push(gpu::trial("pairs/control/a_smaller_light_misses_pairs".into(), |session| {
        let missed: Result<usize, Failed> = (0..SEEDS)
            .map(|seed| {
                let soft = soft(seed, "sphere", 20, 80);
                let middle = soft.case.light;
                let shrink = |s: &[f32; 3]| [0, 1, 2].map(|k| middle[k] + 0.5 * (s[k] - middle[k]));
                let light: Vec<[f32; 3]> = soft.light.iter().map(shrink).collect();
                let found = found(session, &params("ellipsoid", 8, true), &soft.inputs_lit_by(&light))?;
                Ok(needed(&soft).difference(&found).count())
            })
            .sum();
        if missed? > 0 { Ok(()) } else { Err("nothing is missing".into()) }
    }));
    trials
}

fn params(bound: &str, sides: u32, cut: bool) -> Params {
    Params(vec![("sides", Value::U32(sides)), ("bound", Value::Word(bound.into())), ("cut", Value::Bool(cut))])
}

fn needed(soft: &Soft) -> HashSet<(u32, u32)> {
    soft.needed(output(&soft.inputs(), "cell").as_u32())
}

fn found(session: &Session, params: &Params, inputs: &[(&'static str, Array)]) -> Result<HashSet<(u32, u32)>, Failed> {
    let read: Vec<_> = inputs.iter().filter(|(port, _)| PASS.stage.port(port).is_some()).cloned().collect();
    let (mut outputs, counts) =
        session.run_node(&PASS, params, [1, 1], &read).map_err(|problem| problem.to_string())?;
    for (port, array) in &mut outputs {
        if port.starts_with("pair_") {
            *array = Array::u32([counts[0] as usize], array.as_u32()[..counts[0] as usize].to_vec());
        }
    }
    Ok(pairs(&outputs))
}

fn check(session: &Session, index: u64, light: &str) -> Result<(), Failed> {
    let (mut all, mut twin) = (0, 0);
    for seed in 0..SEEDS {
        let soft = soft(1000 * index + seed, light, 12 + 10 * (seed % 3) as usize, 80);
        let (inputs, needed) = (soft.inputs(), needed(&soft));
        for (bound, sides) in KINDS {
            let params = params(bound, sides, seed % 4 != 0);
            let found = found(session, &params, &inputs)?;
            if let Some(pair) = needed.difference(&found).next() {
                let count = needed.difference(&found).count();
                return Err(format!("seed {seed}, {bound} {sides}: {pair:?} and {} more are missing", count - 1).into());
            }
            let (outputs, _) = run_with(&PASS, &params, &inputs).map_err(|problem| problem.to_string())?;
            all += found.len();
            twin += pairs(&outputs).len();
        }
    }
    if all as f64 > SHARE * twin as f64 {
        return Err(format!("{all} pairs where the CPU function finds {twin}").into());
    }
    Ok(())
}
