//! Scenes in which the density of view-samples, as the light sees it, is far from even.

use super::Builtin;
use super::shapes::{COOL, GROUND, LEAF, WARM, bar, cuboid, ground, light_at, look_from, look_through, quad};
use crate::random::Random;
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};

/// `builtin:grazing`.
pub const GRAZING: Builtin = Builtin {
    name: "grazing",
    doc: "fifty thin poles and a light 2.5 degrees above the plane: shadows longer than the scene",
    params: &[],
    build: grazing,
};

/// `builtin:long-view`.
pub const LONG_VIEW: Builtin = Builtin {
    name: "long-view",
    doc: "along a plane of 100 units with a fence, from a height of 0.05: view-samples crowd in a few light texels",
    params: &[],
    build: long_view,
};

/// `builtin:zoom`.
pub const ZOOM: Builtin = Builtin {
    name: "zoom",
    doc: "a centimetre from the edge of a shadow: a frame of a thousandth of the scene",
    params: &[],
    build: zoom,
};

/// `builtin:list-overload`.
pub const LIST_OVERLOAD: Builtin = Builtin {
    name: "list-overload",
    doc: "a speck of a huge plane: over the whole scene's extent every view-sample falls in one light texel",
    params: &[ParamSpec {
        name: "extent",
        range: Range::F32 { min: 10.0, max: 1e6, default: 10_000.0 },
        unit: "scene units",
        doc: "half the side of the plane; the view keeps its size",
    }],
    build: list_overload,
};

/// `builtin:far-light`.
pub const FAR_LIGHT: Builtin = Builtin {
    name: "far-light",
    doc: "a light a million units away: all rays are parallel, and depths differ in their last bits",
    params: &[ParamSpec {
        name: "distance",
        range: Range::F32 { min: 10.0, max: 1e9, default: 1e6 },
        unit: "scene units",
        doc: "from the origin to the light",
    }],
    build: far_light,
};

fn grazing(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 6.0, 0.0);
    let mut random = Random::new(1);
    for _ in 0..50 {
        let foot = vec3(random.range(-4.0, 4.0), 0.0, random.range(-4.0, 4.0));
        bar(&mut soup, [foot, foot + Vec3::Y * 0.5], 0.01, 8, WARM);
    }
    let elevation = 2.5_f32.to_radians();
    light_at(&mut soup, vec3(20.0 * elevation.cos(), 20.0 * elevation.sin(), 3.0), 0.25);
    look_from(&mut soup, vec3(2.0, 3.5, 7.0), vec3(0.0, 0.0, 0.5));
    soup
}

fn long_view(_: &Params) -> Soup {
    let mut soup = Soup::default();
    soup.start_shape();
    quad(
        &mut soup,
        [vec3(-6.0, 0.0, -100.0), vec3(-6.0, 0.0, 2.0), vec3(6.0, 0.0, 2.0), vec3(6.0, 0.0, -100.0)],
        GROUND,
    );
    for post in 0..100 {
        let z = -(post as f32);
        cuboid(&mut soup, vec3(0.8, 0.0, z - 0.03), vec3(0.86, 1.0, z + 0.03), WARM);
    }
    for height in [0.3, 0.7] {
        cuboid(&mut soup, vec3(0.87, height, -99.5), vec3(0.9, height + 0.08, 0.5), COOL);
    }
    light_at(&mut soup, vec3(-25.0, 30.0, -10.0), 0.5);
    look_through(&mut soup, vec3(0.0, 0.05, 1.5), vec3(0.6, 0.05, -10.0), 40.0);
    soup
}

fn zoom(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 5.0, 0.0);
    cuboid(&mut soup, vec3(-0.5, 0.0, -0.5), vec3(0.5, 1.0, 0.5), WARM);
    let light = vec3(3.0, 4.0, 1.0);
    // Where the shadow of the middle of the far upper edge falls.
    let caster = vec3(-0.5, 1.0, 0.0);
    let edge = caster + (caster - light) * (caster.y / (light.y - caster.y));
    light_at(&mut soup, light, 0.1);
    look_from(&mut soup, edge + vec3(0.003, 0.01, 0.002), edge);
    soup
}

fn list_overload(params: &Params) -> Soup {
    let extent = params.f32("extent");
    let mut soup = Soup::default();
    ground(&mut soup, extent, 0.0);
    // Two markers far out hold the extent for frames that follow the casters.
    for side in [-0.9, 0.9] {
        let middle = vec3(side * extent, 0.0, side * extent);
        cuboid(&mut soup, middle - vec3(1.0, 0.0, 1.0), middle + vec3(1.0, 2.0, 1.0), LEAF);
    }
    cuboid(&mut soup, vec3(-0.05, 0.0, -0.05), vec3(0.05, 0.1, 0.05), WARM);
    light_at(&mut soup, vec3(0.5 * extent, extent, 0.25 * extent), 0.01 * extent);
    look_from(&mut soup, vec3(0.2, 0.3, 0.4), Vec3::ZERO);
    soup
}

fn far_light(params: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    cuboid(&mut soup, vec3(-0.8, 0.0, -0.5), vec3(0.0, 1.0, 0.3), WARM);
    for pole in 0..8 {
        let foot = vec3(0.4 + 0.15 * pole as f32, 0.0, -0.8 + 0.2 * pole as f32);
        bar(&mut soup, [foot, foot + Vec3::Y * 1.2], 0.02, 8, COOL);
    }
    light_at(&mut soup, vec3(0.35, 0.85, -0.4).normalize() * params.f32("distance"), 0.0);
    look_from(&mut soup, vec3(2.4, 2.8, 4.0), vec3(0.0, 0.4, 0.0));
    soup
}
