//! A graph by file or built-in name, with the command line's swaps, settings and pins.

use crate::args::GraphChoice;
use crate::{file_problem, usage_problem};
use shadowgraph_core::facts::Facts;
use shadowgraph_core::input;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::{Graph, Keep, Overrides, Source, builtin, builtin_names, load, nearest};
use std::path::Path;

/// Loads a graph with its bases.
///
/// # Errors
/// No such file or built-in graph; what is wrong with its text.
pub fn load_graph(name: &str) -> Result<Graph, Problems> {
    load(source(name)?, &|path| std::fs::read_to_string(path).map_err(|error| file_problem(Path::new(path), &error)))
}

/// Text of a graph: built-in names win over files without an ending.
///
/// # Errors
/// No such file or built-in graph.
pub fn source(name: &str) -> Result<Source, Problem> {
    if let Some(text) = builtin(name) {
        return Ok(Source { name: format!("builtin:{name}"), text: text.into() });
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        let known = builtin_names();
        let remedy = match nearest(name, known.iter().copied()) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("built-in graphs are {}; a file's name ends in .ron", known.join(", ")),
        };
        return Err(Problem::new(Kind::UnknownName, "no built-in graph has this name").found(name).remedy(remedy));
    }
    let text = std::fs::read_to_string(path).map_err(|error| file_problem(path, &error))?;
    Ok(Source { name: name.into(), text })
}

/// The command line's wishes.
///
/// # Errors
/// A flag that does not have the form its help states.
pub fn overrides(choice: &GraphChoice, default_backend: Backend, keep: Keep) -> Result<Overrides, Problems> {
    let mut problems = Vec::new();
    let mut split = |flag: &str, text: &str, at: char, form: &str| match text.split_once(at) {
        Some((left, right)) if !left.is_empty() && !right.is_empty() => Some((left.to_string(), right.to_string())),
        _ => {
            problems.push(usage_problem(format!("{flag} is not understood")).expected(form).found(text));
            None
        }
    };
    let swaps: Vec<_> = choice.swap.iter().filter_map(|text| split("--swap", text, '=', "NODE=PASS")).collect();
    let mut sets = Vec::new();
    for text in &choice.set {
        let Some((place, value)) = split("--set", text, '=', "NODE.PARAM=VALUE") else { continue };
        let Some((node, param)) = split("--set", &place, '.', "NODE.PARAM=VALUE") else { continue };
        sets.push((node, param, value));
    }
    let pins: Vec<_> = choice.on.iter().filter_map(|text| split("--on", text, '=', "NODE=cpu or NODE=wgpu")).collect();
    let mut on = Vec::new();
    for (node, backend) in pins {
        match backend.as_str() {
            "cpu" => on.push((node, Backend::Cpu)),
            "wgpu" => on.push((node, Backend::Wgpu)),
            other => problems.push(usage_problem("--on names no backend").expected("cpu or wgpu").found(other)),
        }
    }
    if !problems.is_empty() {
        return Err(Problems(problems));
    }
    Ok(Overrides { swaps, sets, on, keep, default_backend, alias: !choice.no_alias })
}

/// How many light samples the graph is made for, if it says so.
///
/// # Errors
/// As [`load_graph`].
pub fn light_samples(choice: &GraphChoice) -> Result<Option<u32>, Problems> {
    load_graph(&choice.graph).map(|graph| graph.light_samples())
}

/// Graph inputs of a run: imports only where there are any.
pub fn inputs(with_imports: bool) -> Vec<shadowgraph_core::port::Port> {
    input::ALL.iter().filter(|port| with_imports || !port.name.starts_with("imported_")).copied().collect()
}

/// The checked plan of a choice.
///
/// # Errors
/// Everything that is wrong with graph and flags, at once.
pub fn plan(
    choice: &GraphChoice,
    catalogue: &Catalogue,
    facts: Option<&Facts>,
    default_backend: Backend,
    keep: Keep,
) -> Result<Plan, Problems> {
    let graph = load_graph(&choice.graph)?;
    let overrides = overrides(choice, default_backend, keep)?;
    let inputs = inputs(facts.is_none_or(|facts| facts.view_samples_imported));
    shadowgraph_graph::plan(&graph, catalogue, &inputs, facts, &overrides)
}
