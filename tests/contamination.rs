//! Nothing on a device may depend on what memory held before, on who shares it, or on how often a frame ran: the same outputs,
//! bit for bit, with memory filled with garbage, with sharing off, and after ten frames.

use crate::bench::{job, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::graph_choice;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan, SlotId};
use shadowgraph_graph::Keep;
use shadowgraph_wgpu::{Options, Session};

/// A trial for each graph that runs on a device, and the control.
pub fn trials() -> Vec<Trial> {
    let graphs = ["hard", "hard_fused", "hard_draw", "shadow_map", "pcf", "pcss", "multi_shadow_map"];
    let mut trials: Vec<Trial> = graphs
        .into_iter()
        .map(|graph| gpu::trial(format!("contamination/{graph}"), move |session| unchanged(session, graph)))
        .collect();
    trials.push(gpu::trial("contamination/memory_shared_wrongly_shows".into(), shared_wrongly));
    trials
}

const SCENE: &str = "builtin:columns";
const SIZE: &str = "96x80";

fn plan_of(graph: &str) -> Result<Plan, Failed> {
    let choice = render_args(&[graph]).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let job = job(SCENE, SIZE);
    graph_choice::plan(&choice, &catalogue, Some(&job.facts), Backend::Wgpu, Keep::OutputsOnly)
        .map_err(|problems| problems.to_string().into())
}

fn outputs(session: &Session, plan: &Plan, options: &Options) -> Result<Vec<(SlotId, Array)>, Failed> {
    let job = job(SCENE, SIZE);
    let outcome = session.run(plan, &job.inputs(), job.image, options).map_err(|problem| problem.to_string())?;
    Ok(outcome.arrays)
}

/// Slots whose words differ.
fn differing(plan: &Plan, first: &[(SlotId, Array)], second: &[(SlotId, Array)]) -> Vec<String> {
    let pairs = first.iter().zip(second).filter(|((_, first), (_, second))| first.words() != second.words());
    pairs.map(|((slot, _), _)| plan.slots[*slot].name.clone()).collect()
}

fn unchanged(session: &Session, graph: &str) -> Result<(), Failed> {
    let plan = plan_of(graph)?;
    let plain = Options { timers: false, ..Options::default() };
    let first = outputs(session, &plan, &plain)?;
    for (what, options) in [
        ("poisoned memory", Options { poison: true, ..plain.clone() }),
        ("sharing off", Options { alias: false, ..plain.clone() }),
        ("ten frames", Options { frames: 10, ..plain.clone() }),
        ("a submission for each node", Options { timers: true, ..plain.clone() }),
    ] {
        let faults = differing(&plan, &first, &outputs(session, &plan, &options)?);
        if !faults.is_empty() {
            return Err(format!("{what}: {} changed", faults.join(", ")).into());
        }
    }
    Ok(())
}

/// The control: positions overwritten by list offsets are a difference that must be found.
fn shared_wrongly(session: &Session) -> Result<(), Failed> {
    let plan = plan_of("hard")?;
    let mut wrong = plan.clone();
    let slot = |name: &str| plan.slot(name).ok_or_else(|| Failed::from(format!("no slot {name}")));
    wrong.slots[slot("view_samples.position")?].alias = plan.slots[slot("list_scan.offset")?].alias;
    let options = Options { timers: false, ..Options::default() };
    let faults = differing(&plan, &outputs(session, &plan, &options)?, &outputs(session, &wrong, &options)?);
    if faults.is_empty() { Err("it did not show".into()) } else { Ok(()) }
}
