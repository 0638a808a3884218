//! `shadowgraph check`: every mistake of graph files at once.

use crate::args::CheckArgs;
use crate::graph_choice::{inputs, load_graph};
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::Overrides;

/// What to print, and whether all graphs are right.
pub fn text(catalogue: &Catalogue, args: &CheckArgs) -> (String, bool) {
    let mut all: Vec<Problem> = Vec::new();
    let mut text = String::new();
    for name in &args.graphs {
        match problems_of(catalogue, name) {
            Ok(line) => text.push_str(&line),
            Err(Problems(problems)) => {
                text.push_str(&format!(
                    "{}\n{name}: {} problem{}\n",
                    Problems(problems.clone()),
                    problems.len(),
                    if problems.len() == 1 { "" } else { "s" }
                ));
                all.extend(problems);
            }
        }
    }
    let is_right = all.is_empty();
    if args.json {
        text = serde_json::to_string_pretty(&all).unwrap_or_default();
        text.push('\n');
    }
    (text, is_right)
}

/// Right means right on some backend: a graph of passes that only one backend has is no mistake.
fn problems_of(catalogue: &Catalogue, name: &str) -> Result<String, Problems> {
    let graph = load_graph(name)?;
    let on = |default_backend: Backend| {
        let overrides = Overrides { default_backend, ..Overrides::default() };
        shadowgraph_graph::plan(&graph, catalogue, &inputs(true), None, &overrides)
    };
    let backend_only = |problems: &Problems| problems.0.iter().all(|problem| problem.kind == Kind::Unsupported);
    let (plan, where_text) = match on(Backend::Cpu) {
        Err(problems) if backend_only(&problems) => (on(Backend::Wgpu).map_err(|_| problems)?, ", on wgpu only"),
        other => (other?, ""),
    };
    Ok(format!(
        "{name}: right{where_text}; {} nodes run, {} left out without a scene\n",
        plan.nodes.len(),
        plan.left_out.len()
    ))
}
