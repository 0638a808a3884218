//! `full_sum`: the direct illumination of an area light as a sum over its light samples, visibility and lighting together (Sintorn,
//! Eisemann, Assarsson 2008, equation (1), which the paper then factors "to keep the computations down").
//!
//! In: view-samples (`position`, `normal`, `triangle`, `pixel`, `sample_state`), the scene's `triangles`, `triangle_normals`,
//! `triangle_albedo`, `camera [20]`, `light [8]` (its colour), `mask [P,M]`, `light_samples [L,3]`, `light_weights [L,3]`. Out:
//! `image [H W 4]`, linear RGB and coverage, 1 where a surface is seen.
//!
//! With light sample i in direction l_i at distance d_i, weight w_i (RGB), bit b_i, the interpolated normal n turned to the
//! viewer's side and r_i = 2 (n . l_i) n - l_i:
//! `radiance = albedo ambient + light sum over i of w_i (1 - b_i) a_i (albedo max(n . l_i, 0) + specular max(r_i . v, 0)^shininess)`,
//! a_i = 1 or, with falloff inverse_square, (falloff_distance / d_i)^2; the highlight only where n . l_i > 0.
//!
//! A light sample behind the surface's own plane adds nothing, whatever its bit and the interpolated normal say. Textures and
//! colours of the light are in the weights. With one light sample of weight 1 at the light's centre the picture is `phong`'s
//! within 1e-5 of the larger of 1 and the value, where `sample_filter` drops what faces away.
//!
//! Departures from equation (1): light samples have no normal, so the light shines alike in all directions and the cosine at the
//! light is left out; the factor 1 / pi and the area are in the light's colour, as `falloff` says.
//!
//! On a GPU one invocation takes one loop step a light sample (4096 are well within what is allowed; more than that are refused),
//! and keeps six words of light terms and six of normals for each view-sample.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::params::{AMBIENT, BACKGROUND_BLUE, BACKGROUND_GREEN, BACKGROUND_RED, FALLOFF, FALLOFF_DISTANCE};
use super::reflection::{SHININESS, SPECULAR};
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::problem::{Kind, Problem};

/// The pass.
pub static PASS: Pass = Pass {
    name: "full_sum",
    stage: &super::STAGE,
    doc: "Visibility and lighting summed together over the light samples: equation (1) without factoring.",
    source: "Sintorn 2008, equation (1)",
    ignores: &["corner_light", "visible", "visible_color"],
    params: &[
        SPECULAR,
        SHININESS,
        AMBIENT,
        FALLOFF,
        FALLOFF_DISTANCE,
        BACKGROUND_RED,
        BACKGROUND_GREEN,
        BACKGROUND_BLUE,
    ],
    counters: &[super::OUTSIDE],
    contract: Contract::Within(1e-3),
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

/// Light samples and mask words, from shapes of the ports that are optional in the stage and not here.
///
/// # Errors
/// One is not connected, or they do not belong together.
fn light_shape<'a>(shape: impl Fn(&'static str) -> Option<&'a [usize]>) -> Result<[usize; 2], Problem> {
    let need = |name: &'static str| {
        shape(name).ok_or_else(|| {
            Problem::new(Kind::Missing, "the full sum over light samples needs this port")
                .port(name)
                .expected("a value")
                .found("nothing is connected")
                .remedy("connect it, or use another pass of the stage")
        })
    };
    let rows = |shape: &[usize], axis: usize| shape.get(axis).copied().unwrap_or(1);
    let words = rows(need(ports::MASK.name)?, 1);
    let samples = rows(need(input::LIGHT_SAMPLES.name)?, 0);
    let weights = rows(need(input::LIGHT_WEIGHTS.name)?, 0);
    if weights != samples || samples.div_ceil(32) != words {
        return Err(Problem::new(Kind::BadValue, "mask, light samples and their weights do not belong together")
            .port(input::LIGHT_SAMPLES.name)
            .expected("one weight a light sample, and a mask word for every 32")
            .found(format!("{samples} light samples, {weights} weights, {words} mask words"))
            .remedy("feed the mask that was made from these light samples"));
    }
    Ok([samples, words])
}
