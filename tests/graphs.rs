//! Every built-in graph plans, runs on degenerate scenes on both backends, and answers to swaps.

use crate::bench::{job, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph_core::plan::Backend;
use shadowgraph_graph::{Keep, builtin_names};

const SCENES: &[&str] = &["builtin:empty", "builtin:one-triangle", "builtin:far-light", "builtin:light-inside"];

/// All of them.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for graph in builtin_names() {
        for scene in SCENES {
            trials.push(Trial::test(format!("graphs/{graph}/{scene}/cpu"), move || {
                runs(graph, scene, BackendChoice::Cpu)
            }));
            if !["truth_hard", "truth_soft", "soft_shafts", "soft_silhouettes"].contains(&graph) {
                trials.push(gpu::trial(format!("graphs/{graph}/{scene}/wgpu"), move |_| {
                    runs(graph, scene, BackendChoice::Wgpu)
                }));
            }
        }
    }
    trials.retain(|trial| !trial.name().starts_with("graphs/hard_draw") || trial.name().ends_with("wgpu"));
    trials.push(Trial::test("graphs/a_swap_takes_effect_and_culls_what_it_does_not_need", a_swap_takes_effect));
    trials.push(Trial::test("graphs/a_pass_without_cpu_function_is_refused_before_anything_runs", refused));
    trials
}

fn runs(graph: &'static str, scene: &str, backend: BackendChoice) -> Result<(), Failed> {
    let job = job(scene, "33x31");
    let machine = Machine::new(backend).map_err(|problem| problem.to_string())?;
    let choice = render_args(&[graph]).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let plan = graph_choice::plan(&choice, &catalogue, Some(&job.facts), machine.default_backend, Keep::OutputsOnly)
        .map_err(|problems| problems.to_string())?;
    let outcome = machine.run(&plan, &job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    let image = plan.outputs.iter().find(|(name, _)| name == "image").ok_or("no image")?.1;
    let image = outcome.values.get(image);
    assert_eq!(image.shape(), [31, 33, 4]);
    let finite = image.as_f32().iter().all(|value| value.is_finite());
    if finite { Ok(()) } else { Err("the picture holds numbers that are not finite".into()) }
}

fn a_swap_takes_effect() -> Result<(), Failed> {
    let job = job("builtin:columns", "16x16");
    let catalogue = shadowgraph_passes::catalogue();
    let nodes = |words: &[&str]| -> Result<Vec<String>, Failed> {
        let choice = render_args(words).graph;
        let plan = graph_choice::plan(&choice, &catalogue, Some(&job.facts), Backend::Cpu, Keep::OutputsOnly);
        let plan = plan.map_err(|problems| problems.to_string())?;
        Ok(plan.nodes.iter().map(|node| format!("{}:{}", node.id, node.pass.name)).collect())
    };
    let tables = nodes(&["hard"])?;
    assert!(tables.iter().any(|node| node == "conservative_raster:binning"), "{tables:?}");
    let fused = nodes(&["hard", "--swap", "visibility=fused"])?;
    assert!(fused.iter().any(|node| node == "visibility:fused"), "{fused:?}");
    assert!(
        !fused.iter().any(|node| node.starts_with("conservative_raster") || node.starts_with("caster_scan")),
        "{fused:?}"
    );
    Ok(())
}

fn refused() -> Result<(), Failed> {
    let choice = render_args(&["hard", "--swap", "visibility=fused_draw"]).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let problems =
        graph_choice::plan(&choice, &catalogue, None, Backend::Cpu, Keep::OutputsOnly).err().ok_or("it was planned")?;
    let text = problems.to_string();
    if text.contains("visibility") && text.contains("fused_draw") { Ok(()) } else { Err(text.into()) }
}
