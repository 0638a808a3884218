//! The smallest scenes.

use super::Builtin;
use super::shapes::{COOL, LIGHT, light_at, look_from};
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::Params;

/// `builtin:empty`.
pub const EMPTY: Builtin =
    Builtin { name: "empty", doc: "no triangles: every stage must do nothing, rightly", params: &[], build: empty };

/// `builtin:one-triangle`.
pub const ONE_TRIANGLE: Builtin = Builtin {
    name: "one-triangle",
    doc: "one triangle, which is caster and receiver at once and must not shadow itself",
    params: &[],
    build: one_triangle,
};

fn empty(_: &Params) -> Soup {
    let mut soup = Soup::default();
    view(&mut soup);
    soup
}

fn one_triangle(_: &Params) -> Soup {
    let mut soup = Soup::default();
    soup.flat([vec3(-1.0, 0.1, 0.8), vec3(1.1, 0.2, 0.7), vec3(0.1, 0.6, -1.0)], COOL);
    view(&mut soup);
    soup
}

fn view(soup: &mut Soup) {
    light_at(soup, LIGHT, 0.25);
    look_from(soup, vec3(2.0, 2.5, 3.0), Vec3::ZERO);
}
