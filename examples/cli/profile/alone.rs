//! Each node by itself, on the values it has in a whole run.

use super::times::Series;
use crate::engine::Machine;
use crate::job::Job;
use crate::trial::Trial;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Plan, Producer};
use shadowgraph_core::problem::Problem;
use shadowgraph_cpu::Progress;
use shadowgraph_wgpu::Options;

/// Every node of `plan`, all of whose values are kept, `runs` times after a warm-up; or why nodes cannot run alone.
///
/// # Errors
/// As [`Machine::run`].
pub fn measure(
    machine: &Machine,
    plan: &Plan,
    job: &Job,
    runs: u32,
    progress: &Progress,
) -> Result<Result<Vec<Series>, String>, Problem> {
    if machine.parts_count(plan, job)? > 1 {
        return Ok(Err("view-samples run in parts, each on values of its own".into()));
    }
    let outcome = machine.run(plan, job, 1, progress)?;
    let mut all = Vec::with_capacity(plan.nodes.len());
    for (index, node) in plan.nodes.iter().enumerate() {
        progress(&format!("{} alone", node.id), index as u64, plan.nodes.len() as u64);
        let one = plan.given(|other| other.id != node.id);
        let mut given: Vec<(String, Array)> = Vec::new();
        for (_, slot) in &node.inputs {
            let is_made = matches!(plan.slots[*slot].producer, Producer::Node(_));
            if let (true, Some(array)) = (is_made, outcome.values.try_get(*slot)) {
                given.push((plan.slots[*slot].name.clone(), array.clone()));
            }
        }
        let one = only(&one);
        let mut trial = Trial::new(machine, &one, job, &given, &Options::default(), &|_, _, _| {})?;
        let mut readings = Vec::with_capacity(runs as usize);
        trial.frame(true)?;
        for _ in 0..runs {
            readings.push(trial.frame(true)?.pieces.into_iter().map(|(_, reading)| reading).collect());
        }
        all.push(Series::of(readings.into_iter())?);
    }
    Ok(Ok(all))
}

/// The plan without the values that its node does not touch: they are kept as inputs for nobody.
fn only(plan: &Plan) -> Plan {
    let mut plan = plan.clone();
    for slot in &mut plan.slots {
        slot.keep &= slot.producer != Producer::Input;
    }
    let Plan { slots, outputs, .. } = &mut plan;
    outputs.retain(|(_, slot)| slots[*slot].keep);
    plan.given(|_| false)
}
