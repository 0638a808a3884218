//! Procedural scenes, so that nothing must be downloaded. y is up. Each is a function of its parameters alone and has the
//! same bits on every run, a camera and a light of its own.

mod columns;
mod ends;
mod facets;
mod grass;
mod hairball;
mod moving;
mod plains;
mod random_triangles;
mod rooms;
mod shapes;
mod sheets;
mod spec;
mod thin;
mod torus_knot;
mod touching;

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

const LIST: &[Builtin] = &[
    columns::SCENE,
    torus_knot::SCENE,
    random_triangles::SCENE,
    hairball::SCENE,
    grass::RING,
    touching::CONTACT,
    touching::ALIGNED,
    touching::TWO_DEPTHS,
    touching::HIDDEN,
    plains::GRAZING,
    plains::LONG_VIEW,
    plains::ZOOM,
    plains::LIST_OVERLOAD,
    plains::FAR_LIGHT,
    thin::SCENE,
    sheets::OPEN,
    sheets::NONMANIFOLD,
    sheets::DEGENERATE,
    sheets::TRANSPARENT,
    rooms::LIGHT_INSIDE,
    rooms::OMNI,
    rooms::CAMERA_INSIDE,
    facets::SELF,
    facets::COPLANAR,
    grass::LAWN,
    moving::LIGHT,
    moving::CAMERA,
    ends::EMPTY,
    ends::ONE_TRIANGLE,
];

/// Builds `NAME?param=value&..`.
pub fn build(text: &str) -> Result<Scene, Problem> {
    let (scene, params) = spec::parse(text)?;
    Ok((scene.build)(&params).finish(&format!("{PREFIX}{text}")))
}

#[cfg(test)]
mod tests;
