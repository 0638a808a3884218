//! A plan as text for people.

use crate::overrides::backend_name;
use shadowgraph_core::plan::{Plan, Slot, Step};
use std::collections::HashSet;
use std::fmt::Write;

/// Order of execution with parameters and transfers, every value with its memory and lifetime, and what was left out.
pub fn describe(plan: &Plan) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_plan(plan, &mut text);
    text
}

fn write_plan(plan: &Plan, out: &mut String) -> std::fmt::Result {
    let memories: HashSet<usize> = plan.slots.iter().map(|slot| slot.alias).collect();
    let transfers = plan.steps.iter().filter(|step| matches!(step, Step::Transfer { .. })).count();
    let name = &plan.name;
    let (nodes, slots, memories) = (plan.nodes.len(), plan.slots.len(), memories.len());
    writeln!(out, "{name}: {nodes} nodes, {slots} values in {memories} memories, {transfers} transfers")?;
    writeln!(out, "\norder")?;
    let wide = plan.nodes.iter().map(|node| node.id.chars().count()).max().unwrap_or(0);
    for step in &plan.steps {
        match step {
            Step::Run(index) => {
                let node = &plan.nodes[*index];
                let values = node.params.0.iter().map(|(name, value)| format!("{name}: {}", value.text()));
                let params = values.collect::<Vec<_>>().join(", ");
                let (on, id) = (backend_name(node.on), &node.id);
                let line = format!("{index:>4}  {on:<4}  {id:<wide$}  {:?}  {params}", node.pass);
                writeln!(out, "{}", line.trim_end())?;
            }
            Step::Transfer { slot, to } => {
                writeln!(out, "      {:<4}  transfer of {}", backend_name(*to), plan.slots[*slot].name)?;
            }
        }
    }
    writeln!(out, "\nvalues (memory, first and last node that touches it)")?;
    let wide = plan.slots.iter().map(|slot| slot.name.chars().count()).max().unwrap_or(0);
    for slot in &plan.slots {
        let [first, last] = slot.lifetime;
        let (alias, name, kind) = (slot.alias, &slot.name, slot.port.type_text());
        let kept = if slot.keep { "kept" } else { "" };
        writeln!(out, "{alias:>4}  {first:>4}..{last:<4} {:<8} {kept:<4} {name:<wide$}  {kind}", on_text(slot))?;
    }
    if !plan.outputs.is_empty() {
        writeln!(out, "\noutputs")?;
        for (name, slot) in &plan.outputs {
            writeln!(out, "  {name} = {}", plan.slots[*slot].name)?;
        }
    }
    if !plan.left_out.is_empty() {
        writeln!(out, "\nleft out")?;
        for (id, reason) in &plan.left_out {
            writeln!(out, "  {id}: {reason}")?;
        }
    }
    Ok(())
}

fn on_text(slot: &Slot) -> &'static str {
    match slot.on {
        [true, true] => "cpu+wgpu",
        [true, false] => "cpu",
        [false, true] => "wgpu",
        [false, false] => "",
    }
}
