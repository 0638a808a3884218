//! A node's pass must have a function for the backend the node runs on.

use crate::names::list;
use crate::overrides::backend_name;
use crate::resolve::{Choice, ResolvedNode};
use crate::source::Findings;
use shadowgraph_core::pass::{Catalogue, Pass};
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Kind, Problem};

/// Where the node runs.
pub(crate) fn backend(
    node: &ResolvedNode,
    choice: &Choice,
    default: Backend,
    catalogue: &Catalogue,
    findings: &mut Findings,
) -> Backend {
    let (on, span) = node.on.unwrap_or((default, choice.span));
    if !choice.is_sound || runs_on(choice.pass, on) {
        return on;
    }
    let peers = catalogue.passes().filter(|pass| pass.stage.name == choice.pass.stage.name && runs_on(pass, on));
    let peers: Vec<&str> = peers.map(|pass| pass.name).collect();
    let mut remedies = Vec::new();
    if !peers.is_empty() {
        remedies.push(format!("these passes run there: {}", list(peers.iter().copied(), ", ")));
    }
    let other = if on == Backend::Cpu { Backend::Wgpu } else { Backend::Cpu };
    if runs_on(choice.pass, other) {
        remedies.push(format!("`on: {other:?}` runs this one"));
    }
    let message = format!("pass `{}` does not run on {}", choice.pass.name, backend_name(on));
    let problem = Problem::new(Kind::Unsupported, message).node(&node.id.text);
    let problem = if remedies.is_empty() { problem } else { problem.remedy(remedies.join("; ")) };
    findings.push(span, problem);
    on
}

fn runs_on(pass: &Pass, backend: Backend) -> bool {
    match backend {
        Backend::Cpu => pass.cpu.is_some(),
        Backend::Wgpu => pass.gpu.is_some(),
    }
}
