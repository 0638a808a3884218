//! `shadowgraph graph`: the plan of a graph, or a drawing of it.

use crate::args::{BackendChoice, GraphArgs};
use crate::graph_choice::{plan, source};
use crate::usage_problem;
use shadowgraph_core::facts::Facts;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Place, Problem, Problems};
use shadowgraph_graph::{Keep, builtin_names, describe, drawing, load};

/// The text asked for.
///
/// # Errors
/// What is wrong with graph and flags.
pub fn text(catalogue: &Catalogue, args: &GraphArgs) -> Result<String, Problems> {
    if args.list {
        return list();
    }
    if args.source {
        return Ok(source(&args.graph.graph)?.text);
    }
    let backend = if args.backend == BackendChoice::Wgpu { Backend::Wgpu } else { Backend::Cpu };
    let facts = facts(&args.fact)?;
    let plan = plan(&args.graph, catalogue, Some(&facts), backend, Keep::OutputsOnly)?;
    Ok(match (args.dot, args.mermaid, args.svg) {
        (true, _, _) => drawing::dot(&plan),
        (_, true, _) => drawing::mermaid(&plan),
        (_, _, true) => drawing::svg(&plan),
        _ => describe(&plan),
    })
}

fn list() -> Result<String, Problems> {
    let mut table = crate::report::table(&["graph", "what it is"]);
    for name in builtin_names() {
        let graph = load(source(name)?, &|_| Err(usage_problem("a built-in graph builds on no file")))?;
        table.add_row([name, graph.doc()]);
    }
    Ok(format!("{table}\n"))
}

/// The named facts hold, all others do not.
fn facts(held: &[String]) -> Result<Facts, Problem> {
    let unknown = held.iter().find(|name| !Facts::NAMES.iter().any(|(known, _)| known == name));
    if let Some(name) = unknown {
        let names: Vec<&str> = Facts::NAMES.iter().map(|(name, _)| *name).collect();
        let place = Place { file: "command line".into(), line: 0, column: 0, path: String::new() };
        let problem = usage_problem("no fact has this name").at(place).found(name);
        return Err(problem.expected(format!("one of {}", names.join(", "))));
    }
    let holds = |name: &str| held.iter().any(|held| held == name);
    Ok(Facts {
        light_is_point: holds("light_is_point"),
        light_is_planar: holds("light_is_planar"),
        light_is_textured: holds("light_is_textured"),
        light_inside_scene: holds("light_inside_scene"),
        all_casters_closed: holds("all_casters_closed"),
        transparency_present: holds("transparency_present"),
        scene_is_empty: holds("scene_is_empty"),
        view_samples_imported: holds("view_samples_imported"),
    })
}
