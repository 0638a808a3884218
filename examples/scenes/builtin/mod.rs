//! Procedural scenes, so that nothing must be downloaded. y is up. Each is a function of its parameters alone and has the
//! same bits on every run, a camera and a light of its own.

mod columns;
mod ends;
mod extended;
mod facets;
mod grass;
mod hairball;
mod known;
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

pub use known::Known;

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
    extended::BIG_PENUMBRA,
    extended::VOLUMETRIC,
    extended::TEXTURED,
    known::HALF_PLANE,
    known::SPHERE,
    known::POLYGON,
    known::APART,
    known::NESTED,
    known::FUSION,
    moving::LIGHT,
    moving::CAMERA,
    ends::EMPTY,
    ends::ONE_TRIANGLE,
];

/// Builds `NAME?param=value&..`.
pub fn build(text: &str) -> Result<Scene, Problem> {
    Ok(soup(text)?.finish(&format!("{PREFIX}{text}")))
}

/// The same before it is finished.
pub fn soup(text: &str) -> Result<Soup, Problem> {
    let (scene, params) = spec::parse(text)?;
    Ok((scene.build)(&params))
}

/// Light and casters of `NAME?param=value&..`, if its soft shadow on the ground has a closed form.
///
/// # Errors
/// No such scene, or a wrong parameter.
pub fn known(text: &str) -> Result<Option<Known>, Problem> {
    let (scene, params) = spec::parse(text)?;
    let has_closed_form = known::SCENES.iter().any(|known| known.name == scene.name);
    Ok(if has_closed_form { Known::of(&(scene.build)(&params)) } else { None })
}

#[cfg(test)]
mod tests;
