//! What `in` and `outputs` name must exist and fit.

use crate::names::{did_you_mean, list, nearest};
use crate::resolve::{Explicit, From, Names};
use crate::schema::Name;
use crate::source::Findings;
use shadowgraph_core::port::Port;
use shadowgraph_core::problem::{Kind, Problem};

/// Entries of a node's `in`.
pub(crate) fn wires(index: usize, written: &[(Name, Name)], names: &Names, findings: &mut Findings) -> Vec<Explicit> {
    let Some(stage) = names.stages[index] else { return Vec::new() };
    let id = names.ids[index];
    let mut wires = Vec::with_capacity(written.len());
    for (key, value) in written {
        let mut port = stage.inputs().find(|port| port.name == key.text);
        if port.is_none() {
            let known = stage.ports.iter().filter(|port| port.is_input()).map(|port| port.name);
            let problem =
                Problem::new(Kind::UnknownName, format!("stage `{}` has no input `{}`", stage.name, key.text));
            findings.push(key.span, problem.node(id).remedy(did_you_mean(&key.text, known.clone())));
            port = nearest(&key.text, known).and_then(|near| stage.inputs().find(|port| port.name == near));
        }
        let from = source(value, names);
        if let Err((problem, _)) = &from {
            findings.push(value.span, problem.clone().node(id).port(&key.text));
        }
        let from = from.unwrap_or_else(|(_, near)| near);
        let Some(port) = port else { continue };
        let fits = from.is_none_or(|from| port_of(from, names).fits(port));
        if let Some(from) = from.filter(|_| !fits) {
            let all = (0..names.ids.len()).filter(|node| *node != index);
            let fitting = fitting_names(port, all, names);
            findings.push(
                value.span,
                mismatch(id, port, &source_text(from, &names.ids, &names.inputs), &port_of(from, names), &fitting),
            );
        }
        wires.push(Explicit { port: port.name, from: from.filter(|_| fits), span: value.span });
    }
    wires
}

/// The value that output `key` names.
pub(crate) fn output(key: &Name, value: &Name, names: &Names, findings: &mut Findings) -> Option<From> {
    match source(value, names) {
        Ok(from) => from,
        Err((problem, near)) => {
            let problem = Problem { message: format!("output `{}`: {}", key.text, problem.message), ..problem };
            findings.push(value.span, problem);
            near
        }
    }
}

/// A port is fed something of another type.
pub(crate) fn mismatch(id: &str, port: &Port, source: &str, found: &Port, fitting: &[String]) -> Problem {
    let problem = Problem::new(Kind::PortMismatch, "port is fed a value of another type")
        .node(id)
        .port(port.name)
        .expected(port.type_text())
        .found(format!("{source}: {}", found.type_text()));
    match fitting {
        [] => problem,
        _ => problem.remedy(format!("these fit: {}", list(fitting.iter().map(String::as_str), ", "))),
    }
}

/// `node.port`, or an input's name.
pub(crate) fn source_text(from: From, ids: &[&str], inputs: &[&Port]) -> String {
    match from {
        From::Input(index) => inputs[index].name.into(),
        From::Node(index, port) => format!("{}.{}", ids[index], port.name),
    }
}

fn port_of(from: From, names: &Names) -> Port {
    match from {
        From::Input(index) => *names.inputs[index],
        From::Node(_, port) => *port,
    }
}

fn fitting_names(port: &Port, nodes: impl Iterator<Item = usize>, names: &Names) -> Vec<String> {
    let mut fitting = Vec::new();
    for node in nodes {
        let outputs = names.stages[node].into_iter().flat_map(|stage| stage.outputs());
        let fits = outputs.filter(|output| output.fits(port));
        fitting.extend(fits.map(|output| format!("{}.{}", names.ids[node], output.name)));
    }
    fitting.extend(names.inputs.iter().filter(|input| input.fits(port)).map(|input| input.name.to_string()));
    fitting
}

/// What `name` refers to; on a mistake the problem and what was probably meant. None inside `Ok`: a node of unknown
/// stage, told already.
fn source(name: &Name, names: &Names) -> Result<Option<From>, (Problem, Option<From>)> {
    let Some((id, port)) = name.text.split_once('.') else { return input(name, names).map(Some) };
    let (node, problem) = match names.node(id) {
        Ok(node) => (node, None),
        Err((problem, Some(node))) => (node, Some(problem)),
        Err((problem, None)) => return Err((problem, None)),
    };
    let Some(stage) = names.stages[node] else {
        return problem.map_or(Ok(None), |problem| Err((problem, None)));
    };
    if let Some(found) = stage.outputs().find(|output| output.name == port) {
        let from = From::Node(node, found);
        return problem.map_or(Ok(Some(from)), |problem| Err((problem, Some(from))));
    }
    let known = stage.ports.iter().filter(|port| !port.is_input()).map(|port| port.name);
    let near = nearest(port, known.clone()).and_then(|near| stage.outputs().find(|output| output.name == near));
    let near = near.map(|port| From::Node(node, port));
    let problem = problem.unwrap_or_else(|| {
        let message = match stage.port(port) {
            Some(_) => format!("`{port}` of node `{id}` is an input"),
            None => format!("node `{id}` has no output `{port}`"),
        };
        Problem::new(Kind::UnknownName, message).remedy(did_you_mean(port, known))
    });
    Err((problem, near))
}

fn input(name: &Name, names: &Names) -> Result<From, (Problem, Option<From>)> {
    let find = |text: &str| names.inputs.iter().position(|port| port.name == text).map(From::Input);
    if let Some(from) = find(&name.text) {
        return Ok(from);
    }
    if let Some(node) = names.by_id.get(name.text.as_str()) {
        let outputs = names.stages[*node].into_iter().flat_map(|stage| stage.outputs());
        let outputs: Vec<String> = outputs.map(|port| format!("{}.{}", name.text, port.name)).collect();
        let remedy = format!("its outputs are {}", list(outputs.iter().map(String::as_str), ", "));
        let problem = Problem::new(Kind::Missing, format!("`{}` is a node: say which of its outputs", name.text));
        return Err((problem.remedy(remedy), None));
    }
    let known = names.inputs.iter().map(|port| port.name);
    let problem = Problem::new(Kind::UnknownName, format!("there is no graph input `{}`", name.text));
    let near = nearest(&name.text, known.clone()).and_then(find);
    Err((problem.remedy(did_you_mean(&name.text, known)), near))
}
