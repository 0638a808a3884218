//! A graph, a catalogue and what is known of the scene to a plan.

use crate::check;
use crate::load::Graph;
use crate::overrides::{Keep, Overrides};
use crate::resolve::{Resolved, resolve};
use crate::schedule::{Scheduled, edges, order, schedule};
use crate::source::Findings;
use crate::wire::{Values, Wired, idle_reason, wire};
use crate::world::{Selection, World};
use shadowgraph_core::facts::Facts;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::Plan;
use shadowgraph_core::port::Port;
use shadowgraph_core::problem::Problems;

/// Checks `graph` and orders what of it runs.
///
/// `inputs` are the values that the caller can supply. Without `facts`, every combination of the facts that the graph asks
/// for is checked, and the plan given back is that of the scene where none of them holds.
///
/// # Errors
/// Every mistake of the file, its bases and `overrides` in one go, in the order of the text.
pub fn plan(
    graph: &Graph,
    catalogue: &Catalogue,
    inputs: &[Port],
    facts: Option<&Facts>,
    overrides: &Overrides,
) -> Result<Plan, Problems> {
    let mut findings = graph.findings.clone();
    let resolved = resolve(graph, catalogue, inputs, overrides, &mut findings);
    let values = Values::new(&resolved);
    let worlds = match facts {
        Some(facts) => vec![World::of(facts)],
        None => World::all(&resolved),
    };
    let mut first = None;
    for world in worlds {
        let selection = world.select(&resolved);
        if facts.is_some() || first.is_none() {
            check::unused_sets(&resolved, facts.map(|_| &selection), &mut findings);
        }
        let plan = plan_world(&resolved, &selection, &values, catalogue, overrides, &mut findings);
        first = first.or(plan);
    }
    match first {
        Some(mut plan) if findings.is_empty() => {
            plan.name = graph.name.clone();
            Ok(plan)
        }
        _ => Err(findings.finish(&graph.files, &overrides.flags())),
    }
}

/// The plan of one world, if nothing in it is wrong.
fn plan_world(
    resolved: &Resolved,
    selection: &Selection,
    values: &Values,
    catalogue: &Catalogue,
    overrides: &Overrides,
    findings: &mut Findings,
) -> Option<Plan> {
    let wired = wire(resolved, selection, values, findings);
    let edges = edges(resolved, &wired);
    let order = order(&edges);
    if order.len() < edges.node_count() {
        check::cycles(&edges, resolved, findings);
    }
    let mut on = Vec::with_capacity(order.len());
    for (index, node) in resolved.nodes.iter().enumerate().filter(|(index, _)| wired.is_live[*index]) {
        let Some(choice) = selection.chosen[index].map(|choice| &node.choices[choice]) else { continue };
        on.push((index, check::backend(node, choice, overrides.default_backend, catalogue, findings)));
    }
    if !findings.is_empty() {
        return None;
    }
    // `on` is in the order of the file.
    let on_of = |node: &usize| match on.binary_search_by_key(node, |(index, _)| *index) {
        Ok(at) => on[at].1,
        Err(_) => unreachable!("node {node} is ordered and has no backend"),
    };
    let on: Vec<_> = order.iter().map(on_of).collect();
    let mut plan = schedule(&Scheduled {
        resolved,
        selection,
        wired: &wired,
        order: &order,
        on: &on,
        keep_all: overrides.keep == Keep::AllLivePorts,
        alias: overrides.alias,
    });
    plan.left_out = left_out(resolved, selection, &wired);
    Some(plan)
}

/// Nodes, `node/pass` alternatives and `node.param` values of the file that have no part in the run, with the reason.
fn left_out(resolved: &Resolved, selection: &Selection, wired: &Wired) -> Vec<(String, String)> {
    let mut left_out = Vec::new();
    for (index, node) in resolved.nodes.iter().enumerate() {
        let id = &node.id.text;
        let Some(chosen) = selection.chosen[index] else {
            left_out.push((id.clone(), node.guard.text(selection.world)));
            continue;
        };
        if !wired.is_live[index] {
            left_out.push((id.clone(), idle_reason(index, resolved, selection, wired)));
            continue;
        }
        let taken = &node.choices[chosen];
        for (other, choice) in node.choices.iter().enumerate().filter(|(other, _)| *other != chosen) {
            let reason = match choice.guard.holds(selection.world) {
                // A later alternative, or the node's own pass.
                true => format!("{} is used: {}", taken.pass.name, taken.guard.text(selection.world)),
                false => choice.guard.text(selection.world),
            };
            debug_assert!(other > chosen || !choice.guard.holds(selection.world));
            left_out.push((format!("{id}/{}", choice.pass.name), reason));
        }
        for param in &taken.dropped {
            let reason = format!("was meant for another pass; {} takes no such value", taken.pass.name);
            left_out.push((format!("{id}.{param}"), reason));
        }
    }
    left_out
}
