//! Recipes of soft visibility on random scenes with area lights, among them degenerate ones, long cells and view-samples in no cell,
//! against brute force, and tables against their CPU functions.

use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::pass::Pass;
use shadowgraph_core::shared::KEPT;
use shadowgraph_passes::shared::area_light_scenes::{SoftCase, add_table, disc, soft, soft_planar, soft_tilted};
use shadowgraph_passes::shared::hard_scenes::{Case, Inputs, Random, output, random, run};
use shadowgraph_wgpu::Session;

/// Share of wrong bits: light samples in the middle of casters' edges make determinants that are zero, but not in two floats.
const EXACT_SHARE: f64 = 3e-4;
/// Share of bits in which the backends' look-ups may differ: planes next to the border of a bin.
const LOOK_UP_SHARE: f64 = 4e-3;

fn pass(stage: &str, name: &str) -> Result<&'static Pass, Failed> {
    shadowgraph_passes::catalogue().pass(stage, name).ok_or_else(|| format!("no pass {stage}/{name}").into())
}

fn on_device(session: &Session, pass: &'static Pass, size: u32, inputs: &Inputs) -> Result<(Inputs, Vec<u64>), Failed> {
    let params = Params(pass.params.iter().map(|spec| (spec.name, Value::U32(size))).collect());
    let reads = |port: &str| pass.reads().any(|read| read.name == port);
    let inputs: Inputs = inputs.iter().filter(|(port, _)| reads(port)).cloned().collect();
    Ok(session.run_node(pass, &params, [1, 1], &inputs).map_err(|problem| problem.to_string())?)
}

fn wrong_bits(found: &[u32], wanted: &[u32]) -> u64 {
    assert_eq!(found.len(), wanted.len());
    found.iter().zip(wanted).map(|(a, b)| u64::from((a ^ b).count_ones())).sum()
}

fn check(what: &str, wrong: u64, bits: u64, share: f64) -> Result<(), Failed> {
    println!("{what}: {wrong} of {bits} bits");
    // One wrong bit of a small scene is let pass.
    if wrong as f64 <= (share * bits as f64).max(1.0) {
        Ok(())
    } else {
        Err(format!("{what}: {wrong} of {bits} bits").into())
    }
}

/// Scenes that cover both ways of a cell, short and long, and a light's blocks.
fn scenes() -> Vec<(SoftCase, usize)> {
    let mut scenes = Vec::new();
    for (seed, light_sample_count) in (0..).zip([1, 5, 32, 33, 128, 129, 256, 300]) {
        scenes.push((soft(20_000 + seed, 24, 70, light_sample_count), 1 + seed as usize % 3));
        scenes.push((soft(30_000 + seed, 24, 70, light_sample_count), 1));
    }
    let mut long = soft(40_000, 2_500, 24, 40);
    long.case.side = 1;
    scenes.push((long, 1));
    let hard = random(50_000, 30, 300);
    scenes.push((SoftCase { samples: vec![hard.light], case: hard }, 1));
    scenes
}

fn exact(session: &Session, name: &'static str) -> Result<(), Failed> {
    let (mut wrong, mut bits) = (0, 0);
    for (index, (case, more)) in scenes().into_iter().enumerate() {
        let mut inputs = case.inputs(more);
        if name == "lu_certain" {
            add_table(&mut inputs, "certain_uncertain", 32);
        }
        if index % 5 == 4 {
            for (port, array) in &mut inputs {
                match *port {
                    "cell" => array.words_mut().fill(u32::MAX),
                    "list_offset" | "caster_offset" => array.words_mut().fill(0),
                    _ => {}
                }
            }
        }
        let (outputs, _) = on_device(session, pass("visibility", name)?, 32, &inputs)?;
        let (found, wanted) = (output(&outputs, "mask").as_u32(), case.mask());
        let here = wrong_bits(found, &wanted);
        if here > 0 {
            println!("scene {index}: {here} wrong bits of {}", 32 * wanted.len());
        }
        wrong += here;
        bits += 32 * wanted.len() as u64;
    }
    check(name, wrong, bits, EXACT_SHARE)
}

/// All light samples at one height, and a level caster `ulps` above it: over the light the caster's plane has one value, next to zero.
fn level(height: f32, ulps: i32) -> SoftCase {
    let at = f32::from_bits(height.to_bits().wrapping_add_signed(ulps));
    let r = &mut Random(7);
    let mut case = Case {
        triangles: [0.0, at].map(|y| [[-4.0, y, -4.0], [0.0, y, 6.0], [4.0, y, -4.0]]).to_vec(),
        light: [0.0, height, 0.0],
        position: (0..40).map(|_| [r.signed(), 0.0, r.signed()]).collect(),
        triangle: vec![0; 40],
        state: vec![KEPT; 40],
        casts: vec![1; 2],
        faces: Vec::new(),
        side: 2,
    };
    case.look(false, false);
    SoftCase { case, samples: (0..100).map(|_| [r.signed(), height, r.signed()]).collect() }
}

fn level_casters(session: &Session, name: &'static str) -> Result<(), Failed> {
    for height in [1.0, 0.7, 3.0] {
        for ulps in [-2, -1, 1, 2] {
            let case = level(height, ulps);
            let mut inputs = case.inputs(1);
            add_table(&mut inputs, "certain_uncertain", 32);
            let (outputs, _) = on_device(session, pass("visibility", name)?, 32, &inputs)?;
            let wanted = case.mask();
            assert!(wanted.iter().all(|word| (*word == 0) == (ulps > 0)), "what is above the light hides nothing");
            let wrong = wrong_bits(output(&outputs, "mask").as_u32(), &wanted);
            if wrong > 0 {
                return Err(format!("{wrong} wrong bits under a caster {ulps} ulp above {height}").into());
            }
        }
    }
    Ok(())
}

fn look_ups(session: &Session, name: &'static str, table: &str) -> Result<(), Failed> {
    let (mut wrong, mut bits) = (0, 0);
    for seed in 0..8 {
        let scene = [soft_planar, soft_tilted][seed as usize / 4];
        let case = scene(60_000 + seed, 24, 70, [128, 200][seed as usize % 2]);
        let mut inputs = case.inputs(1);
        add_table(&mut inputs, table, 64);
        let pass = pass("visibility", name)?;
        let (outputs, _) = on_device(session, pass, 64, &inputs)?;
        let (twin, _) = run(pass, &inputs).map_err(|problem| problem.to_string())?;
        let wanted = output(&twin, "mask").as_u32();
        wrong += wrong_bits(output(&outputs, "mask").as_u32(), wanted);
        bits += 32 * wanted.len() as u64;
    }
    check(name, wrong, bits, LOOK_UP_SHARE)
}

fn tables(session: &Session, table: &'static str, size: u32) -> Result<(), Failed> {
    for light_sample_count in [1, 100, 200] {
        let case = soft_planar(9, 4, 10, light_sample_count);
        let mut inputs = case.inputs(1);
        let (outputs, _) = on_device(session, pass("lu_table", table)?, size, &inputs)?;
        add_table(&mut inputs, table, size);
        let layout = |outputs: &Inputs| output(outputs, "lu_layout").as_f32().to_vec();
        let bound = 1e-5 * (1.0 + case.case.light.iter().fold(0.0f32, |most, x| most.max(x.abs())));
        if layout(&outputs).iter().zip(&layout(&inputs)).any(|(a, b)| (a - b).abs() > bound) {
            return Err(format!("layouts {:?} and {:?}", layout(&outputs), layout(&inputs)).into());
        }
        let (found, wanted) = (output(&outputs, "lu").as_u32(), output(&inputs, "lu").as_u32());
        check(table, wrong_bits(found, wanted), 32 * wanted.len() as u64, 1e-4)?;
    }
    Ok(())
}

/// Discs whose plane is not through the middle of their box: taken, and with the layout and table of the CPU.
fn tilted(session: &Session) -> Result<(), Failed> {
    let mut case = soft_planar(9, 4, 10, 1);
    for (seed, count) in (0..).zip([3, 16, 64, 256]) {
        for centre in [[3.0, 10.0, 2.0], [300.0, 1000.0, -200.0]] {
            case.samples = disc(&mut Random(seed), centre, centre, 0.5, count);
            let mut inputs = case.inputs(1);
            let (outputs, counts) = on_device(session, pass("lu_table", "planar")?, 256, &inputs)?;
            add_table(&mut inputs, "planar", 256);
            let [found, wanted] = [&outputs, &inputs].map(|of| output(of, "lu_layout").as_f32().to_vec());
            if counts[0] > 0 {
                return Err(format!("{} of {count} light samples off the plane", counts[0]).into());
            }
            if wanted[15].abs() < 1e-3 || (found[15] - wanted[15]).abs() > 1e-6 * centre[1] {
                return Err(format!("layouts {found:?} and {wanted:?}").into());
            }
            let (found, wanted) = (output(&outputs, "lu").as_u32(), output(&inputs, "lu").as_u32());
            check("tilted", wrong_bits(found, wanted), 32 * wanted.len() as u64, 1e-3)?;
        }
    }
    Ok(())
}

fn off_plane(session: &Session) -> Result<(), Failed> {
    let mut case = soft_planar(9, 4, 10, 50);
    case.samples[20][1] += 0.01 * (case.samples[1][0] - case.samples[0][0]).abs();
    let (_, counts) = on_device(session, pass("lu_table", "planar")?, 64, &case.inputs(1))?;
    if counts[0] > 0 { Ok(()) } else { Err("no light sample was found off the plane".into()) }
}

/// All of them.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for name in ["half_planes", "lu_certain"] {
        trials.push(gpu::trial(format!("area_lights/{name}"), move |session| exact(session, name)));
        let run = move |session: &_| level_casters(session, name);
        trials.push(gpu::trial(format!("area_lights/{name}/level"), run));
    }
    for (name, table) in [("lu", "angles_distance"), ("lu_planar", "planar")] {
        trials.push(gpu::trial(format!("area_lights/{name}"), move |session| look_ups(session, name, table)));
    }
    for (table, size) in [("angles_distance", 64), ("certain_uncertain", 32), ("planar", 256)] {
        trials.push(gpu::trial(format!("area_lights/table/{table}"), move |session| tables(session, table, size)));
    }
    trials.push(gpu::trial("area_lights/table/planar/tilted".to_string(), tilted));
    trials.push(gpu::trial("area_lights/table/planar/refuses".to_string(), off_plane));
    trials
}
