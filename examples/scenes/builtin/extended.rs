//! Scenes for lights that are large, solid or textured.

use super::Builtin;
use super::shapes::{COOL, LEAF, WARM, bar, board, cuboid, ground, light_at, look_from, sphere};
use crate::soup::Soup;
use glam::{EulerRot, Quat, Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::scene::{Light, LightShape, Texture};

/// `builtin:big-penumbra`.
pub const BIG_PENUMBRA: Builtin = Builtin {
    name: "big-penumbra",
    doc: "rows of spheres under a light of radius 2: penumbrae over penumbrae, which methods add or take the darkest of",
    params: &[ParamSpec {
        name: "per_side",
        range: Range::U32 { min: 1, max: 64, default: 9 },
        unit: "spheres",
        doc: "in each of two directions; 480 triangles each",
    }],
    build: big_penumbra,
};

/// `builtin:volumetric`.
pub const VOLUMETRIC: Builtin = Builtin {
    name: "volumetric",
    doc: "a solid light: a tilted ellipsoid 1 : 4 : 0.2, or two balls; methods for flat or round lights get its shape wrong",
    params: &[ParamSpec {
        name: "light",
        range: Range::Word { words: &["ellipsoid", "dumbbell"], default: "ellipsoid" },
        unit: "",
        doc: "the light's shape",
    }],
    build: volumetric,
};

/// `builtin:textured`.
pub const TEXTURED: Builtin = Builtin {
    name: "textured",
    doc: "a light of 16 cells in two colours, some dark: each light sample counts by its colour",
    params: &[],
    build: textured,
};

fn big_penumbra(params: &Params) -> Soup {
    let per_side = params.u32("per_side");
    let mut soup = Soup::default();
    ground(&mut soup, 5.0, 0.0);
    let place = |index: u32| (index as f32 - (per_side - 1) as f32 / 2.0) * 0.6;
    for (row, column) in (0..per_side).flat_map(|row| (0..per_side).map(move |column| (row, column))) {
        let look = [WARM, COOL, LEAF][((row + column) % 3) as usize];
        sphere(&mut soup, vec3(place(column), 0.45, place(row)), 0.2, 20, 13, look);
    }
    light_at(&mut soup, vec3(0.8, 4.5, -0.6), 2.0);
    look_from(&mut soup, vec3(3.4, 4.4, 6.2), vec3(0.0, 0.1, 0.2));
    soup
}

/// Things that stand, hang and lean between the ground and a light at height 3.
fn things(soup: &mut Soup) {
    ground(soup, 3.0, 0.0);
    cuboid(soup, vec3(-0.9, 0.0, -0.4), vec3(-0.6, 0.9, -0.1), WARM);
    bar(soup, [vec3(0.4, 0.0, 0.3), vec3(0.4, 1.2, 0.3)], 0.04, 12, COOL);
    bar(soup, [vec3(-0.4, 0.0, 0.7), vec3(0.3, 0.8, 0.9)], 0.03, 12, COOL);
    sphere(soup, vec3(0.9, 0.5, -0.5), 0.3, 32, 16, LEAF);
    board(soup, vec3(0.0, 1.1, -0.8), 0.35, WARM);
}

fn volumetric(params: &Params) -> Soup {
    let mut soup = Soup::default();
    things(&mut soup);
    let centre = vec3(0.2, 3.0, 0.0);
    let tilt = Quat::from_euler(EulerRot::ZYX, 0.7, 0.4, 0.0);
    let light = match params.word("light") {
        "dumbbell" => {
            let end = tilt * (0.9 * Vec3::Y);
            let ball = |at: Vec3| Light::sphere("end", at.to_array(), 0.25);
            Light::shaped("default", centre.to_array(), LightShape::Parts(vec![ball(centre - end), ball(centre + end)]))
        }
        _ => {
            let half_axes = [Vec3::X * 0.25, Vec3::Y, Vec3::Z * 0.05].map(|axis| (tilt * axis).to_array());
            Light::shaped("default", centre.to_array(), LightShape::Ellipsoid { half_axes })
        }
    };
    soup.lights.push(light);
    look_from(&mut soup, vec3(2.0, 2.6, 3.8), vec3(0.0, 0.4, 0.0));
    soup
}

fn textured(_: &Params) -> Soup {
    let mut soup = Soup::default();
    things(&mut soup);
    let [red, blue, dark] = [[2.2, 1.1, 0.3], [0.3, 1.2, 2.4], [0.0; 3]];
    let texels = vec![
        red, red, dark, blue, //
        red, dark, blue, blue, //
        dark, red, dark, blue, //
        red, red, blue, dark,
    ];
    let half_axes = [[0.8, 0.0, 0.0], [0.0, 0.0, -0.8]];
    let light = Light::shaped("default", [0.1, 3.0, 0.1], LightShape::Rectangle { half_axes });
    soup.lights.push(light.textured(Texture { width: 4, height: 4, texels }));
    look_from(&mut soup, vec3(2.0, 2.6, 3.8), vec3(0.0, 0.4, 0.0));
    soup
}
