//! A chain-link fence.

use super::Builtin;
use super::shapes::{COOL, bar, ground, light_at, look_from};
use crate::soup::Soup;
use glam::vec3;
use shadowgraph_core::param::{ParamSpec, Params, Range};

/// `builtin:thin`.
pub const SCENE: Builtin = Builtin {
    name: "thin",
    doc: "crossing wires of radius 0.004: casters thinner than a texel, which a raster without cover everywhere loses",
    params: &[ParamSpec {
        name: "wires",
        range: Range::U32 { min: 1, max: 512, default: 64 },
        unit: "wires",
        doc: "in each of two directions; 28 triangles each",
    }],
    build,
};

const RADIUS: f32 = 0.004;
const SIDES: u32 = 8;

fn build(params: &Params) -> Soup {
    let wires = params.u32("wires");
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    for wire in 0..wires {
        let place = (wire as f32 + 0.5) / wires as f32 * 2.0 - 1.0;
        // The two directions pass each other without touching.
        let (front, back) = (1.5 * RADIUS, -1.5 * RADIUS);
        bar(&mut soup, [vec3(place, 0.02, front), vec3(place, 1.6, front)], RADIUS, SIDES, COOL);
        let height = 0.8 + 0.76 * place;
        bar(&mut soup, [vec3(-1.0, height, back), vec3(1.0, height, back)], RADIUS, SIDES, COOL);
    }
    light_at(&mut soup, vec3(0.8, 4.5, -3.0), 0.25);
    look_from(&mut soup, vec3(1.6, 2.4, 4.6), vec3(0.0, 0.5, 0.5));
    soup
}
