//! Stages, passes and graph inputs must exist.

use crate::names::{did_you_mean, nearest};
use crate::schema::{Name, NodeWritten};
use crate::source::{Findings, Span};
use shadowgraph_core::pass::{Catalogue, Pass};
use shadowgraph_core::port::Port;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::stage::Stage;
use std::collections::HashMap;

/// The stage of a node, or the one that was probably meant.
pub(crate) fn stage(
    node: &NodeWritten,
    passes: &HashMap<&'static str, Vec<&'static Pass>>,
    catalogue: &Catalogue,
    findings: &mut Findings,
) -> Option<&'static Stage> {
    let name = node.stage();
    if let Some(passes) = passes.get(name.text.as_str()) {
        return Some(passes[0].stage);
    }
    let stages = catalogue.stages();
    let known = stages.iter().map(|stage| stage.name);
    let mut problem = Problem::new(Kind::UnknownName, format!("there is no stage `{}`", name.text)).node(&node.id.text);
    let remedy = did_you_mean(&name.text, known.clone());
    problem = match node.stage {
        Some(_) => problem.remedy(remedy),
        None => problem.remedy(format!("{remedy}; a node that names no stage is of the stage its id names")),
    };
    findings.push(name.span, problem);
    nearest(&name.text, known).and_then(|near| catalogue.stage(near))
}

/// The pass called `name`, or the nearest, or the stage's first; where it is named; whether it is the named one.
pub(crate) fn pass(
    name: &str,
    span: Span,
    id: &Name,
    passes: &[&'static Pass],
    findings: &mut Findings,
) -> (&'static Pass, Span, bool) {
    let find = |name: &str| passes.iter().find(|pass| pass.name == name).copied();
    if let Some(pass) = find(name) {
        return (pass, span, true);
    }
    let known = passes.iter().map(|pass| pass.name);
    let message = format!("stage `{}` has no pass `{name}`", passes[0].stage.name);
    let problem = Problem::new(Kind::UnknownName, message).node(&id.text);
    findings.push(span, problem.remedy(did_you_mean(name, known.clone())));
    (nearest(name, known).and_then(find).unwrap_or(passes[0]), span, false)
}

/// The graph's inputs: those it names, else all that the program supplies.
pub(crate) fn inputs<'g>(named: Option<&[Name]>, supplied: &'g [Port], findings: &mut Findings) -> Vec<&'g Port> {
    let Some(named) = named else { return supplied.iter().collect() };
    let mut inputs = Vec::new();
    for name in named {
        let find = |text: &str| supplied.iter().find(|port| port.name == text);
        let known = supplied.iter().map(|port| port.name);
        if find(&name.text).is_none() {
            let problem = Problem::new(Kind::UnknownName, format!("there is no graph input `{}`", name.text));
            findings.push(name.span, problem.remedy(did_you_mean(&name.text, known.clone())));
        }
        inputs.extend(find(&name.text).or_else(|| nearest(&name.text, known).and_then(find)));
    }
    inputs
}
