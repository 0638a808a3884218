//! View-samples in ranges give, bit for bit, what a single run gives.

use crate::bench::{job, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::ranges::Ranges;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::Grown;
use shadowgraph_graph::Keep;

const SIZE: &str = "70x50";

/// Graphs on both backends.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for graph in ["hard", "hard_fused", "shadow_map"] {
        trials.push(Trial::test(format!("ranges/{graph}/cpu"), move || equal(graph, BackendChoice::Cpu)));
        trials.push(gpu::trial(format!("ranges/{graph}/wgpu"), move |_| equal(graph, BackendChoice::Wgpu)));
    }
    trials.push(gpu::trial("ranges/as_few_as_the_bindings_allow".into(), |_| as_few_as_needed()));
    trials
}

fn outputs(graph: &str, backend: BackendChoice, ranges: u32) -> Result<Vec<(String, Array)>, Failed> {
    let machine = Machine::new(backend).map_err(|problem| problem.to_string())?.in_ranges(ranges);
    let job = job("builtin:columns", SIZE);
    let plan = graph_choice::plan(
        &render_args(&[graph]).graph,
        &shadowgraph_passes::catalogue(),
        Some(&job.facts),
        machine.default_backend,
        Keep::OutputsOnly,
    )
    .map_err(|problems| problems.to_string())?;
    let outcome = machine.run(&plan, &job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    Ok(plan.outputs.iter().map(|(name, slot)| (name.clone(), outcome.values.get(*slot).clone())).collect())
}

fn equal(graph: &str, backend: BackendChoice) -> Result<(), Failed> {
    let whole = outputs(graph, backend, 1)?;
    for ranges in [2, 7] {
        for ((name, one), (_, other)) in whole.iter().zip(outputs(graph, backend, ranges)?) {
            if *one != other {
                return Err(format!("{name} differs in {ranges} ranges").into());
            }
        }
    }
    Ok(())
}

/// Masks of 1024 light samples for 1920x1080 need two bindings of 128 MiB.
fn as_few_as_needed() -> Result<(), Failed> {
    let job = job("builtin:columns", "64x64");
    let plan = graph_choice::plan(
        &render_args(&["hard"]).graph,
        &shadowgraph_passes::catalogue(),
        Some(&job.facts),
        shadowgraph_core::plan::Backend::Wgpu,
        Keep::OutputsOnly,
    )
    .map_err(|problems| problems.to_string())?;
    let inputs: Vec<_> = job.inputs().iter().map(|(name, array)| (name.clone(), array.shape().to_vec())).collect();
    let mut shapes = plan.shapes(&inputs, [64, 64], &Grown::new()).map_err(|problem| problem.to_string())?;
    let mask = plan.slot("visibility.mask").ok_or("no mask")?;
    let ranges = Ranges::of(&plan);
    shapes.0[mask] = vec![1920 * 1080, 32];
    match (ranges.needed(&plan, &shapes, 128 << 20), ranges.needed(&plan, &shapes, 1 << 30)) {
        (2, 1) => Ok(()),
        other => Err(format!("{other:?}").into()),
    }
}
