//! Procedural scenes, so that nothing must be downloaded. y is up. Each is a function of its parameters alone and has the
//! same bits on every run, a camera and a light of its own.

mod columns;
mod ends;
mod random_triangles;
mod shapes;
mod spec;

use crate::soup::Soup;
use shadowgraph_core::param::{ParamSpec, Params};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::Scene;

/// What a built-in scene's name begins with on a command line.
pub const PREFIX: &str = "builtin:";

/// A procedural scene.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Builtin {
    /// Name behind [`PREFIX`].
    pub name: &'static str,
    /// What it shows, and what it is hard for.
    pub doc: &'static str,
    /// Its parameters.
    pub params: &'static [ParamSpec],
    /// Builds it.
    #[serde(skip)]
    pub build: fn(&Params) -> Soup,
}

/// All of them, in the order of documentation.
pub fn list() -> &'static [Builtin] {
    LIST
}

const LIST: &[Builtin] = &[columns::SCENE, random_triangles::SCENE, ends::EMPTY, ends::ONE_TRIANGLE];

/// Builds `NAME?param=value&..`.
pub fn build(text: &str) -> Result<Scene, Problem> {
    let (scene, params) = spec::parse(text)?;
    Ok((scene.build)(&params).finish(&format!("{PREFIX}{text}")))
}

#[cfg(test)]
mod tests;
