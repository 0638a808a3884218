//! Casters that touch receivers, lie along the light's rays, or hide behind each other.

use super::Builtin;
use super::shapes::{COOL, LEAF, LIGHT, WARM, board, cuboid, ground, light_at, look_from, quad};
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::Params;
use shadowgraph_core::scene::flag;

/// `builtin:contact`.
pub const CONTACT: Builtin = Builtin {
    name: "contact",
    doc: "cubes that rest on the ground and touch face to face: any bias shows as a gap",
    params: &[],
    build: contact,
};

/// `builtin:aligned`.
pub const ALIGNED: Builtin = Builtin {
    name: "aligned",
    doc: "a quad and box faces in planes through the light and the camera: edge-on triangles must not block",
    params: &[],
    build: aligned,
};

/// `builtin:two-depths`.
pub const TWO_DEPTHS: Builtin = Builtin {
    name: "two-depths",
    doc: "a pillar near the receiver and a wall far above it in one bundle of light rays: layered depths leak",
    params: &[],
    build: two_depths,
};

/// `builtin:hidden`.
pub const HIDDEN: Builtin = Builtin {
    name: "hidden",
    doc: "a cap behind a cap: the lower cannot be seen from the light's centre",
    params: &[],
    build: hidden,
};

fn contact(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    let unit = Vec3::ONE;
    let low = vec3(-0.5, 0.0, -0.5);
    cuboid(&mut soup, low, low + unit, WARM);
    cuboid(&mut soup, vec3(0.5, 0.0, -0.25), vec3(1.25, 0.75, 0.5), COOL);
    cuboid(&mut soup, vec3(-0.25, 1.0, -0.25), vec3(0.25, 1.5, 0.25), LEAF);
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(2.4, 2.6, 3.6), vec3(0.2, 0.5, 0.0));
    soup
}

fn aligned(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    soup.start_shape();
    // The plane x = 0 has the light, the eye and the looked-at point in it.
    let corner = |y: f32, z: f32| vec3(0.0, y, z);
    let thin = [corner(0.0, -1.0), corner(0.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    quad(&mut soup, thin, COOL.with(flag::TWO_SIDED));
    cuboid(&mut soup, vec3(0.0, 0.0, 1.25), vec3(0.5, 0.5, 1.75), WARM);
    cuboid(&mut soup, vec3(-0.5, 0.25, -1.75), vec3(0.0, 0.75, -1.25), WARM);
    // Two faces of this box lie in the plane z = -0.5 through the light.
    cuboid(&mut soup, vec3(1.0, 0.0, -0.5), vec3(1.5, 0.75, 0.0), LEAF);
    light_at(&mut soup, vec3(0.0, 4.0, -0.5), 0.25);
    look_from(&mut soup, vec3(0.0, 3.0, 5.0), vec3(0.0, 0.25, 0.0));
    soup
}

fn two_depths(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    cuboid(&mut soup, vec3(-0.1, 0.0, -0.1), vec3(0.1, 0.8, 0.1), WARM);
    // A wall on legs of nothing, nearer to the light, whose shadow's edge crosses the pillar's shadow.
    cuboid(&mut soup, vec3(0.2, 2.4, -0.6), vec3(0.9, 2.5, 0.1), COOL);
    cuboid(&mut soup, vec3(-1.6, 0.0, 0.9), vec3(-0.6, 0.9, 1.0), LEAF);
    light_at(&mut soup, vec3(1.2, 4.5, -1.2), 0.25);
    look_from(&mut soup, vec3(-2.6, 3.2, 4.4), vec3(-0.2, 0.4, 0.2));
    soup
}

fn hidden(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    // Seen from the light at height 4.5 the upper covers a square of half 0.396 at the lower's height.
    board(&mut soup, vec3(0.0, 2.0, 0.0), 0.3, WARM);
    board(&mut soup, vec3(0.0, 1.2, 0.0), 0.25, COOL);
    light_at(&mut soup, vec3(0.0, 4.5, 0.0), 0.5);
    look_from(&mut soup, vec3(1.8, 2.6, 3.8), vec3(0.0, 0.5, 0.0));
    soup
}
