//! Parameters of every way to shade.

use glam::Vec3;
use shadowgraph_core::param::{ParamSpec, Params, Range};

const fn color(name: &'static str, default: f32) -> ParamSpec {
    ParamSpec {
        name,
        range: Range::F32 { min: 0.0, max: 1e6, default },
        unit: "linear radiance",
        doc: "what pixels without a surface show",
    }
}

/// Red of the background.
pub const BACKGROUND_RED: ParamSpec = color("background_red", 0.05);
/// Green of the background.
pub const BACKGROUND_GREEN: ParamSpec = color("background_green", 0.06);
/// Blue of the background.
pub const BACKGROUND_BLUE: ParamSpec = color("background_blue", 0.08);
/// Light that is everywhere.
pub const AMBIENT: ParamSpec = ParamSpec {
    name: "ambient",
    range: Range::F32 { min: 0.0, max: 1e6, default: 0.08 },
    unit: "share of albedo",
    doc: "light that no caster blocks: surfaces in shadow are easier to see as it grows, and shadows paler",
};
/// Whether distance weakens the light.
pub const FALLOFF: ParamSpec = ParamSpec {
    name: "falloff",
    range: Range::Word { words: &["none", "inverse_square"], default: "none" },
    unit: "",
    doc: "none: the light is equally strong everywhere; inverse_square: as its colour says at falloff_distance",
};
/// Where the light is as strong as its colour says.
pub const FALLOFF_DISTANCE: ParamSpec = ParamSpec {
    name: "falloff_distance",
    range: Range::F32 { min: 1e-6, max: 1e9, default: 1.0 },
    unit: "scene units",
    doc: "with falloff inverse_square, brighter as it grows",
};

/// Their values.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Linear RGB.
    pub background: Vec3,
    /// Share of albedo.
    pub ambient: f32,
    /// Distance of full strength, scene units, if distance weakens the light.
    pub falloff_distance: Option<f32>,
}

impl Settings {
    /// From a node's parameters.
    pub fn new(params: &Params) -> Self {
        let color = [BACKGROUND_RED, BACKGROUND_GREEN, BACKGROUND_BLUE].map(|spec| params.f32(spec.name));
        let falls_off = params.word(FALLOFF.name) == "inverse_square";
        Self {
            background: Vec3::from(color),
            ambient: params.f32(AMBIENT.name),
            falloff_distance: falls_off.then(|| params.f32(FALLOFF_DISTANCE.name)),
        }
    }
    /// What the colour of a light is divided by that lies `offset` away: 1, or the square of the distance.
    pub fn weakening(&self, offset: Vec3) -> f32 {
        self.falloff_distance.map_or(1.0, |distance| {
            let distances = (offset / distance).length().max(1e-6);
            distances * distances
        })
    }
}
