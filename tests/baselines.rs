//! The baselines of soft shadows: what they must equal, how near to the truth they are, and where they must fail.

use crate::bench::{job_lit, render_args, verify_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::commands::verify::verify;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph_core::array::Array;
use shadowgraph_graph::Keep;

const SOFT: &[&str] = &["--light-samples", "40", "--light-radius", "0.3"];

/// Scenes on which rays keep their contract; `degenerate` holds faces that lie in one another.
const RAY_SCENES: &[&str] =
    &["columns", "contact", "thin", "coplanar-p?pixels=32", "degenerate", "light-inside", "far-light"];

/// All of them.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for scene in ["columns", "light-inside", "random-triangles?count=2000"] {
        let run = move |backend| one_sample_is_one_map(scene, backend);
        trials.push(Trial::test(format!("baselines/one_light_sample_is_one_shadow_map/{scene}/cpu"), move || {
            run(BackendChoice::Cpu)
        }));
        let name = format!("baselines/one_light_sample_is_one_shadow_map/{scene}/wgpu");
        trials.push(gpu::trial(name, move |_| run(BackendChoice::Wgpu)));
    }
    for scene in RAY_SCENES {
        trials.push(Trial::test(format!("baselines/rays_soft_is_right/{scene}/cpu"), move || {
            wrong_share(&["rays_soft", "--backend", "cpu"], scene).and_then(|share| within(share, 0.0, 1e-3))
        }));
    }
    trials.push(gpu::trial("baselines/rays_soft_is_right/columns/wgpu".into(), |_| {
        wrong_share(&["rays_soft", "--backend", "wgpu"], "columns").and_then(|share| within(share, 0.0, 1e-3))
    }));
    trials.push(Trial::test("baselines/rays_soft_of_one_light_sample_is_rays", one_sample_is_one_ray));
    trials.push(Trial::test("baselines/shadow_maps_of_64_texels_are_wrong", || {
        let coarse = ["multi_shadow_map", "--backend", "cpu", "--set", "visibility.size=64"];
        let fine = ["multi_shadow_map", "--backend", "cpu", "--set", "visibility.size=1024"];
        let (coarse, fine) = (wrong_share(&coarse, "columns")?, wrong_share(&fine, "columns")?);
        assert!(fine < coarse / 2.0, "{fine} with fine maps, {coarse} with coarse ones");
        within(coarse, 0.01, 0.5)
    }));
    trials.push(Trial::test("baselines/pcss_is_near_and_not_right", || {
        let share = grey_error("pcss", "columns")?;
        within(share, 0.01, 0.2)
    }));
    trials.push(Trial::test("baselines/control/a_planted_bit_is_found", || {
        let masks = Array::u32([2, 2], vec![1, 2, 3, 4]);
        let other = Array::u32([2, 2], vec![1, 2, 7, 4]);
        assert!(same(&masks, &masks).is_ok() && same(&masks, &other).is_err());
        Ok(())
    }));
    trials.push(gpu::trial("baselines/rays_without_a_tree_are_refused_on_wgpu".into(), |_| {
        match output(&["hard", "--swap", "visibility=bvh_rays"], "columns", "16x16", &[], BackendChoice::Wgpu, "mask") {
            Err(failed) if failed.message().is_some_and(|text| text.contains("bvh_build")) => Ok(()),
            Err(failed) => Err(failed),
            Ok(_) => Err("they ran".into()),
        }
    }));
    trials
}

fn within(value: f64, low: f64, high: f64) -> Result<(), Failed> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(format!("{value} is not within {low}..={high}").into()) }
}

/// Output `name` of a graph.
fn output(
    words: &[&str],
    scene: &str,
    size: &str,
    light: &[&str],
    backend: BackendChoice,
    name: &str,
) -> Result<Array, Failed> {
    let job = job_lit(&format!("builtin:{scene}"), size, light);
    let machine = Machine::new(backend).map_err(|problem| problem.to_string())?;
    let choice = render_args(words).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let plan = graph_choice::plan(&choice, &catalogue, Some(&job.facts), machine.default_backend, Keep::OutputsOnly)
        .map_err(|problems| problems.to_string())?;
    let outcome = machine.run(&plan, &job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    let slot = plan.outputs.iter().find(|(known, _)| known == name).ok_or("no such output")?.1;
    Ok(outcome.values.get(slot).clone())
}

fn same(one: &Array, other: &Array) -> Result<(), Failed> {
    if one.shape() != other.shape() {
        return Err(format!("shapes {:?} and {:?}", one.shape(), other.shape()).into());
    }
    let differ = one.words().iter().zip(other.words()).filter(|(one, other)| one != other).count();
    if differ == 0 { Ok(()) } else { Err(format!("{differ} of {} words differ", one.words().len()).into()) }
}

fn one_sample_is_one_map(scene: &str, backend: BackendChoice) -> Result<(), Failed> {
    let mask = |words: &[&str]| output(words, scene, "96x72", &[], backend, "mask");
    let many = mask(&["multi_shadow_map", "--set", "visibility.size=256", "--set", "visibility.normal_offset=0.5"])?;
    let one = mask(&["shadow_map", "--set", "light_depth.size=256", "--set", "shadow_lookup.normal_offset=0.5"])?;
    assert!(one.as_u32().contains(&1) && one.as_u32().contains(&0));
    same(&many, &one)
}

fn one_sample_is_one_ray() -> Result<(), Failed> {
    let mask = |graph: &str| output(&[graph], "columns", "96x72", &[], BackendChoice::Cpu, "mask");
    same(&mask("rays_soft")?, &mask("rays")?)
}

/// Wrong bits outside the contact band over all bits, with 40 light samples.
fn wrong_share(words: &[&str], scene: &str) -> Result<f64, Failed> {
    let args = verify_args(&[words, &["--truth", "truth_soft", "--quiet"]].concat());
    let job = job_lit(&format!("builtin:{scene}"), "96x72", SOFT);
    let mut machine = Machine::new(args.run.backend).map_err(|problem| problem.to_string())?;
    let catalogue = shadowgraph_passes::catalogue();
    let row = verify(&catalogue, &args, &mut machine, String::new(), &job).map_err(|problems| problems.to_string())?;
    Ok(row.verdict.wrong_outside_share)
}

/// Root of the mean square difference of visible fractions over the view-samples in true penumbra.
fn grey_error(graph: &str, scene: &str) -> Result<f64, Failed> {
    let visible = |graph: &str| output(&[graph], scene, "96x72", SOFT, BackendChoice::Cpu, "visible");
    let (found, truth) = (visible(graph)?, visible("truth_soft")?);
    let pairs = found.as_f32().iter().zip(truth.as_f32());
    let squares: Vec<f64> = pairs
        .filter(|(_, truth)| **truth > 0.0 && **truth < 1.0)
        .map(|(found, truth)| f64::from(found - truth).powi(2))
        .collect();
    assert!(squares.len() > 100, "{} view-samples in penumbra", squares.len());
    Ok((squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}
