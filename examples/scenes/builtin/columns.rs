//! Fluted columns on a ground square.

use super::Builtin;
use super::shapes::{WARM, ground, light_at, look_from, turned};
use crate::soup::Soup;
use glam::vec3;
use shadowgraph_core::param::{ParamSpec, Params, Range};

/// `builtin:columns`.
pub const SCENE: Builtin = Builtin {
    name: "columns",
    doc: "fluted columns on a ground square: closed casters, long parallel shadows",
    params: &[
        ParamSpec {
            name: "count",
            range: Range::U32 { min: 1, max: 64, default: 6 },
            unit: "columns",
            doc: "columns on a ring",
        },
        ParamSpec {
            name: "flutes",
            range: Range::U32 { min: 3, max: 512, default: 20 },
            unit: "flutes",
            doc: "flutes around each; four sides a flute",
        },
    ],
    build,
};

const HEIGHT: f32 = 2.4;
const RADIUS: f32 = 0.2;
const FLUTE_DEPTH: f32 = 0.08;

fn build(params: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 4.0, 0.0);
    let (count, flutes) = (params.u32("count"), params.u32("flutes"));
    for column in 0..count {
        let turn = column as f32 / count as f32 * std::f32::consts::TAU;
        let middle = vec3(1.5 * turn.cos(), 0.0, 1.5 * turn.sin());
        let heights: Vec<f32> = (0..=16).map(|ring| HEIGHT * ring as f32 / 16.0).collect();
        let point = |height: f32, angle: f32| {
            // Columns swell a little, narrow to the top, and flare into a plate at both ends.
            let share = height / HEIGHT;
            let entasis = 1.0 - 0.22 * share * share;
            let flare = 1.0 + 0.35 * (-(share.min(1.0 - share) * 40.0)).exp();
            let flute = 1.0 - FLUTE_DEPTH * (0.5 - 0.5 * (angle * flutes as f32).cos());
            let radius = RADIUS * entasis * flare * flute;
            middle + vec3(radius * angle.sin(), height, radius * angle.cos())
        };
        turned(&mut soup, 4 * flutes, &heights, point, WARM);
    }
    light_at(&mut soup, vec3(3.2, 5.0, 2.4), 0.25);
    look_from(&mut soup, vec3(-4.4, 3.4, 5.8), vec3(0.0, 0.9, 0.0));
    soup
}
