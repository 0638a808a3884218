//! Scenes whose soft shadow on the ground has a closed form (see `closed_form`): each shape after the ground is a convex caster
//! between the ground and a flat light.

use super::Builtin;
use super::shapes::{COOL, WARM, ground, look_from, rectangle_light_at, sphere};
use crate::soup::{Look, Soup};
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::scene::{Light, LightShape, flag};

/// `builtin:half-plane`.
pub const HALF_PLANE: Builtin = Builtin {
    name: "half-plane",
    doc: "a straight edge under a square light: the penumbra is a linear ramp",
    params: &[],
    build: half_plane,
};

/// `builtin:sphere-over-disc`.
pub const SPHERE: Builtin = Builtin {
    name: "sphere-over-disc",
    doc: "a sphere under a disc light: right below it the light is a ring, beside it the lens of two circles is dark",
    params: &[ParamSpec {
        name: "facets",
        range: Range::U32 { min: 4, max: 512, default: 48 },
        unit: "facets",
        doc: "around the sphere's equator; half as many from pole to pole",
    }],
    build: sphere_over_disc,
};

/// `builtin:polygon`.
pub const POLYGON: Builtin = Builtin {
    name: "polygon",
    doc: "one tilted convex polygon under a rectangle light: its projection cut to the rectangle is dark",
    params: &[],
    build: polygon,
};

/// `builtin:apart`.
pub const APART: Builtin = Builtin {
    name: "apart",
    doc: "two tilted polygons that cover different parts of the light: what is blocked adds up",
    params: &[],
    build: apart,
};

/// `builtin:nested`.
pub const NESTED: Builtin = Builtin {
    name: "nested",
    doc: "a polygon right below a larger one: the smaller blocks nothing more, methods that add make it darker",
    params: &[],
    build: nested,
};

/// `builtin:fusion`.
pub const FUSION: Builtin = Builtin {
    name: "fusion",
    doc: "two half-planes; seen from x = 0 they cover one half of the light each, or both the same half",
    params: &[ParamSpec {
        name: "halves",
        range: Range::Word { words: &["other", "same"], default: "other" },
        unit: "",
        doc: "other: all is blocked on x = 0; same: one half",
    }],
    build: fusion,
};

/// All of them.
pub const SCENES: &[Builtin] = &[HALF_PLANE, SPHERE, POLYGON, APART, NESTED, FUSION];

/// Height of the light's plane.
const LIGHT_HEIGHT: f32 = 3.0;
/// Half planes end so far away, which is beyond all that blocks light on the ground.
const FAR: f32 = 12.0;

/// A light and convex casters.
pub struct Known {
    /// A rectangle or a disc.
    pub light: Light,
    /// Vertices of each, in any order, some more than once.
    pub casters: Vec<Vec<Vec3>>,
}

impl Known {
    /// Every shape but the first, which is the ground.
    pub fn of(soup: &Soup) -> Option<Self> {
        let light = soup.lights.first()?.clone();
        let ground = *soup.shapes.first()?;
        let mut casters: Vec<(u32, Vec<Vec3>)> = Vec::new();
        for (corners, shape) in soup.positions.iter().zip(&soup.shapes).filter(|(_, shape)| **shape != ground) {
            let vertices = corners.map(Vec3::from);
            match casters.last_mut() {
                Some((last, caster)) if last == shape => caster.extend(vertices),
                _ => casters.push((*shape, vertices.to_vec())),
            }
        }
        Some(Self { light, casters: casters.into_iter().map(|(_, vertices)| vertices).collect() })
    }
}

/// A convex polygon that casts from both sides, as a fan.
fn plate(soup: &mut Soup, corners: &[Vec3], look: Look) {
    soup.start_shape();
    for pair in corners[1..].windows(2) {
        soup.flat([corners[0], pair[0], pair[1]], look.with(flag::TWO_SIDED));
    }
}

/// All of the plane y = `height` on one side of x = 0.
fn half(soup: &mut Soup, side: f32, height: f32, look: Look) {
    let corner = |x: f32, z: f32| vec3(x * side * FAR, height, z * FAR);
    plate(soup, &[corner(0.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(0.0, 1.0)], look);
}

/// A ground with a square light above.
fn under_square(half: f32) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    rectangle_light_at(&mut soup, vec3(0.0, LIGHT_HEIGHT, 0.0), [half, half]);
    soup
}

fn half_plane(_: &Params) -> Soup {
    let mut soup = under_square(0.5);
    half(&mut soup, -1.0, 1.2, WARM);
    look_from(&mut soup, vec3(2.6, 1.0, 3.2), vec3(-0.2, 0.0, 0.0));
    soup
}

fn sphere_over_disc(params: &Params) -> Soup {
    let facets = params.u32("facets");
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    let half_axes = [[0.6, 0.0, 0.0], [0.0, 0.0, 0.6]];
    soup.lights.push(Light::shaped("default", [0.0, LIGHT_HEIGHT, 0.0], LightShape::Disc { half_axes }));
    sphere(&mut soup, vec3(0.0, 1.2, 0.0), 0.4, facets, facets / 2, COOL);
    look_from(&mut soup, vec3(1.8, 2.6, 3.8), vec3(0.0, 0.4, 0.0));
    soup
}

fn polygon(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    rectangle_light_at(&mut soup, vec3(0.0, LIGHT_HEIGHT, 0.0), [0.7, 0.3]);
    let corner = |degrees: f32, radius: f32| {
        let (z, x) = degrees.to_radians().sin_cos();
        radius * vec3(x, 0.5 * x + 0.2 * z, z) + vec3(0.1, 1.2, -0.1)
    };
    let corners = [(0.0, 0.6), (70.0, 0.5), (150.0, 0.55), (210.0, 0.6), (290.0, 0.4)];
    plate(&mut soup, &corners.map(|(degrees, radius)| corner(degrees, radius)), WARM);
    look_from(&mut soup, vec3(-3.0, 3.0, 2.6), vec3(0.0, 0.4, 0.0));
    soup
}

fn apart(_: &Params) -> Soup {
    let mut soup = under_square(0.6);
    for (side, look) in [(-1.0, WARM), (1.0, COOL)] {
        let corner = |x: f32, z: f32| vec3(side * (0.06 + x), 1.1 + 0.4 * x + 0.1 * side, z);
        plate(&mut soup, &[corner(0.0, -0.4), corner(0.5, -0.3), corner(0.6, 0.2), corner(0.1, 0.5)], look);
    }
    look_from(&mut soup, vec3(1.8, 2.6, 3.8), vec3(0.0, 0.4, 0.0));
    soup
}

fn nested(_: &Params) -> Soup {
    let mut soup = under_square(0.6);
    for (half, height, look) in [(0.5, 1.25, WARM), (0.35, 1.24, COOL)] {
        let corner = |x: f32, z: f32| vec3(x * half, height, z * half);
        plate(&mut soup, &[corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)], look);
    }
    look_from(&mut soup, vec3(1.8, 2.6, 3.8), vec3(0.0, 0.4, 0.0));
    soup
}

fn fusion(params: &Params) -> Soup {
    let mut soup = under_square(0.5);
    half(&mut soup, -1.0, 1.2, WARM);
    half(&mut soup, if params.word("halves") == "same" { -1.0 } else { 1.0 }, 1.6, COOL);
    look_from(&mut soup, vec3(2.2, 1.0, 3.4), vec3(0.0, 0.0, 0.0));
    soup
}
