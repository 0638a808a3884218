//! Light samples: points on a light, as stored data that every method shares.
//!
//! A generator gives `[L 3]` world positions and `[L 3]` weights: the RGB share of the light that each sample carries. A white,
//! uniform light has 1/L in every channel. The same light, count and seed give the same bits on every run.

mod hammersley;

use glam::DVec3;
use shadowgraph_core::scene::Light;

/// Most light samples of a light.
pub const MOST_SAMPLES: usize = 4096;

/// Points on a light and the share of it that each carries.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSamples {
    /// World space.
    pub positions: Vec<[f32; 3]>,
    /// Linear RGB share; a uniform white light of L samples has 1/L in every channel.
    pub weights: Vec<[f32; 3]>,
}

/// `count` points of `light`: its centre for one sample or no extent, else well spread through its sphere.
pub fn samples(light: &Light, count: usize) -> LightSamples {
    let centre = DVec3::from(light.position.map(f64::from));
    let at = |index: usize| {
        let point = centre + f64::from(light.radius) * hammersley::in_ball(index, count);
        point.as_vec3().to_array()
    };
    let positions =
        if count <= 1 || light.radius == 0.0 { vec![light.position] } else { (0..count).map(at).collect::<Vec<_>>() };
    let weights = vec![[1.0 / positions.len() as f32; 3]; positions.len()];
    LightSamples { positions, weights }
}
