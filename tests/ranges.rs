//! View-samples in ranges give, bit for bit, what a single run gives.

use crate::bench::{job, job_lit, render_args, verify_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::commands::verify::verify;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::job::Job;
use shadowgraph::ranges::Ranges;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::Grown;
use shadowgraph_graph::Keep;

const SIZE: &str = "70x50";
const LIGHT: &[&str] = &["--light-samples", "40", "--light-radius", "2"];

/// Graphs on both backends.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for graph in
        ["hard", "hard_fused", "shadow_map", "soft", "soft_certain", "soft_penumbra", "soft_lu", "pcss", "rays_soft"]
    {
        trials.push(Trial::test(format!("ranges/{graph}/cpu"), move || equal(graph, BackendChoice::Cpu)));
        trials.push(gpu::trial(format!("ranges/{graph}/wgpu"), move |_| equal(graph, BackendChoice::Wgpu)));
    }
    for backend in ["cpu", "wgpu"] {
        let run = move || jittered_is_right(backend);
        trials.push(match backend {
            "cpu" => Trial::test("ranges/jitter/cpu", run),
            _ => gpu::trial("ranges/jitter/wgpu".into(), move |_| run()),
        });
    }
    trials.push(Trial::test("ranges/jitter/pixels_ask_other_samples", pixels_differ));
    trials.push(gpu::trial("ranges/as_few_as_the_bindings_allow".into(), |_| as_few_as_needed()));
    trials
}

fn outputs(graph: &str, backend: BackendChoice, ranges: u32) -> Result<Vec<(String, Array)>, Failed> {
    let machine = Machine::new(backend).map_err(|problem| problem.to_string())?.in_ranges(ranges);
    let light: &[&str] = if ["soft", "rays_soft"].iter().any(|soft| graph.starts_with(soft)) { LIGHT } else { &[] };
    let job = job_lit("builtin:columns", SIZE, light);
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

/// Masks of 1024 light samples for 1920x1080 and their queues need three bindings of 128 MiB.
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
    let ranges = Ranges::of(&plan, false);
    shapes.0[mask] = vec![1920 * 1080, 32];
    match (ranges.needed(&plan, &shapes, 128 << 20), ranges.needed(&plan, &shapes, 1 << 30)) {
        (3, 1) => Ok(()),
        other => Err(format!("{other:?}").into()),
    }
}

const JITTERED: &[&str] = &["--light-samples", "20", "--light-radius", "2", "--jitter", "turn", "--jitter-side", "2"];

/// Every pixel is judged by the truth for its own sample set.
fn jittered_is_right(backend: &str) -> Result<(), Failed> {
    let words =
        [&["soft", "--truth", "truth_soft", "--backend", backend, "--size", SIZE, "--quiet"], JITTERED].concat();
    let args = verify_args(&words);
    let job = Job::load(&args.scene).map_err(|problem| problem.to_string())?;
    let mut machine = Machine::new(args.run.backend).map_err(|problem| problem.to_string())?;
    let row = verify(&shadowgraph_passes::catalogue(), &args, &mut machine, String::new(), &job)
        .map_err(|problems| problems.to_string())?;
    let all = &row.verdict.all;
    match (all.bits_count, row.verdict.wrong_outside_count) {
        (bits, wrong) if bits > 0 && wrong as f64 <= if backend == "cpu" { 0.0 } else { 1.0 } => Ok(()),
        other => Err(format!("(bits, wrong): {other:?}").into()),
    }
}

/// Jitter changes the masks of all pixels of the pattern but the first, and of that hardly: a view-sample faces away when it does so
/// from the samples of all sets.
fn pixels_differ() -> Result<(), Failed> {
    let masks = |words: &[&str]| -> Result<Array, Failed> {
        let args = render_args(&[&["truth_soft", "--backend", "cpu", "--size", SIZE], words].concat());
        let job = Job::load(&args.scene).map_err(|problem| problem.to_string())?;
        let machine = Machine::new(args.run.backend).map_err(|problem| problem.to_string())?;
        let catalogue = shadowgraph_passes::catalogue();
        let plan =
            graph_choice::plan(&args.graph, &catalogue, Some(&job.facts), machine.default_backend, Keep::OutputsOnly)
                .map_err(|problems| problems.to_string())?;
        let outcome = machine.run(&plan, &job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
        let slot = plan.slot("visibility.mask").ok_or("no mask")?;
        Ok(outcome.values.get(slot).clone())
    };
    let (plain, jittered) = (masks(&JITTERED[..4])?, masks(JITTERED)?);
    let mut changed = [0; 2];
    for (pixel, (one, other)) in plain.words().iter().zip(jittered.words()).enumerate() {
        let is_first = pixel % 70 % 2 == 0 && pixel / 70 % 2 == 0;
        changed[usize::from(is_first)] += usize::from(one != other);
    }
    if changed[0] > 50 && changed[1] * 50 < changed[0] { Ok(()) } else { Err(format!("{changed:?}").into()) }
}
