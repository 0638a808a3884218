//! Graphs against a catalogue of passes that do nothing.

mod drawings;
mod fake;
mod loading;
mod mistakes;
mod plans;
mod properties;
mod speed;

use crate::{Graph, Keep, Overrides, Source, load, plan};
use fake::catalogue;
use shadowgraph_core::facts::Facts;
use shadowgraph_core::input;
use shadowgraph_core::plan::Plan;
use shadowgraph_core::problem::{Kind, Problem, Problems};

fn no_files(path: &str) -> Result<String, Problem> {
    Err(Problem::new(Kind::File, "no such file").found(path))
}

fn load_text(text: &str) -> Result<Graph, Problems> {
    load(Source { name: "test.ron".into(), text: text.into() }, &no_files)
}

fn load_builtin(name: &str) -> Graph {
    let text = crate::builtin(name).unwrap_or_else(|| panic!("no built-in {name}")).to_string();
    load(Source { name: format!("builtin:{name}"), text }, &no_files).unwrap_or_else(|problems| panic!("{problems}"))
}

/// An outdoor scene, a point light.
fn facts() -> Facts {
    Facts {
        light_is_point: true,
        light_is_textured: false,
        light_is_planar: true,
        light_inside_scene: false,
        all_casters_closed: false,
        transparency_present: false,
        scene_is_empty: false,
        view_samples_imported: false,
    }
}

fn plan_of(graph: &Graph, overrides: &Overrides) -> Result<Plan, Problems> {
    plan(graph, &catalogue(), input::ALL, Some(&facts()), overrides)
}

fn plan_text(text: &str) -> Result<Plan, Problems> {
    plan_of(&load_text(text)?, &Overrides::default())
}

/// One line for each problem of a text, as a user sees it.
fn complaints(text: &str) -> Vec<String> {
    match load_text(text).and_then(|graph| plan(&graph, &catalogue(), input::ALL, None, &Overrides::default())) {
        Ok(_) => Vec::new(),
        Err(problems) => problems.0.iter().map(ToString::to_string).collect(),
    }
}

fn ids(plan: &Plan) -> Vec<&str> {
    plan.nodes.iter().map(|node| node.id.as_str()).collect()
}
