//! What shading makes of masks: the full sum and the factored form agree where they must, on both backends.

use crate::bench::{render_args, soft_job};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::job::Job;
use shadowgraph_core::array::Array;
use shadowgraph_graph::Keep;

const SCENES: &[&str] = &["builtin:columns", "builtin:textured", "builtin:light-inside"];

/// All of them.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for scene in SCENES {
        let one = move |backend| one_sample_is_phong(scene, backend);
        trials.push(Trial::test(format!("shading/one_sample_is_phong/{scene}/cpu"), move || one(BackendChoice::Cpu)));
        let name = format!("shading/one_sample_is_phong/{scene}/wgpu");
        trials.push(gpu::trial(name, move |_| one(BackendChoice::Wgpu)));
    }
    trials.push(Trial::test("shading/uniform_weights_are_counts", uniform_weights_are_counts));
    trials.push(Trial::test("shading/a_textured_light_is_weighted_by_itself", textured_lights_are_weighted));
    trials
}

/// An output of a graph.
fn output(job: &Job, words: &[&str], name: &str, backend: BackendChoice) -> Result<Array, Failed> {
    let machine = Machine::new(backend).map_err(|problem| problem.to_string())?;
    let choice = render_args(words).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let plan = graph_choice::plan(&choice, &catalogue, Some(&job.facts), machine.default_backend, Keep::OutputsOnly)
        .map_err(|problems| problems.to_string())?;
    let outcome = machine.run(&plan, job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    let slot = plan.outputs.iter().find(|(output, _)| output == name).ok_or(format!("no output {name}"))?.1;
    Ok(outcome.values.get(slot).clone())
}

/// The largest difference, relative to the larger of 1 and the value.
fn difference(one: &Array, other: &Array) -> f32 {
    assert_eq!(one.shape(), other.shape());
    let pairs = one.as_f32().iter().zip(other.as_f32());
    pairs.map(|(a, b)| (a - b).abs() / a.abs().max(1.0)).fold(0.0, f32::max)
}

fn one_sample_is_phong(scene: &str, backend: BackendChoice) -> Result<(), Failed> {
    let job = soft_job(scene, "96x72", "1");
    let picture = |pass: &str, specular: &str| {
        let (swap, set) = (format!("shade={pass}"), format!("shade.specular={specular}"));
        let falloff = ["--set", "shade.falloff=inverse_square", "--set", "shade.falloff_distance=3.0"];
        let words = [&["hard", "--swap", &swap, "--set", &set], &falloff[..]].concat();
        output(&job, &words, "image", backend)
    };
    let (factored, full) = (picture("phong", "0.5")?, picture("full_sum", "0.5")?);
    if difference(&factored, &full) > 1e-5 {
        return Err(format!("they differ by {}", difference(&factored, &full)).into());
    }
    // The comparison sees a weaker highlight.
    let planted = difference(&factored, &picture("full_sum", "0.4")?);
    if planted > 1e-3 { Ok(()) } else { Err(format!("another highlight makes {planted} only").into()) }
}

fn uniform_weights_are_counts() -> Result<(), Failed> {
    let job = soft_job("builtin:two-depths", "64x48", "100");
    let visible =
        |pass: &str| output(&job, &["truth_soft", "--swap", &format!("combine={pass}")], "visible", BackendChoice::Cpu);
    let (counted, weighted) = (visible("popcount")?, visible("weighted")?);
    assert!(counted.as_f32().iter().any(|visible| (0.1..0.9).contains(visible)), "no penumbra is seen");
    let difference = difference(&counted, &weighted);
    if difference <= 1e-5 { Ok(()) } else { Err(format!("they differ by {difference}").into()) }
}

fn textured_lights_are_weighted() -> Result<(), Failed> {
    let job = soft_job("builtin:textured", "64x48", "64");
    let image = |swap: &[&str]| output(&job, &[&["truth_soft"], swap].concat(), "image", BackendChoice::Cpu);
    let (by_itself, weighted) = (image(&[])?, image(&["--swap", "combine=weighted"])?);
    assert_eq!(by_itself, weighted);
    let grey = difference(&by_itself, &image(&["--swap", "combine=popcount"])?);
    if grey > 0.05 { Ok(()) } else { Err(format!("colours change the picture by {grey} only").into()) }
}
