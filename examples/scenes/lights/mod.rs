//! Light samples: points on a light, as stored data that every method shares (Sintorn 2008, section 4).
//!
//! [`sample`] gives `[L 3]` world positions and `[L 3]` weights, the RGB share of the light that each sample carries. It needs no file
//! and no program: hosts call it with any [`Light`], and [`points_light`], [`surface_light`] and [`volume_light`] make one of points
//! or of a mesh. The same light, generator, count and seed give the same bits on every run.
//!
//! Invariants: one sample is the light's position; so are all samples of a light without extent. Every channel's weights sum to
//! one, whatever the light's colour and texture: what a texture takes away is taken off [`LightSamples::color`]. A uniform white
//! light of L samples has weights of 1/L, bit for bit.
//!
//! | File | What it holds |
//! |---|---|
//! | `generator` `hammersley` `jittered` `lattice` | points of the unit square and cube |
//! | `shapes` `surface` `volume` | from there to a light, equal areas and volumes staying equal |
//! | `emission` | colours and textures to weights |
//! | `drawn` | a light to points with their colours |
//! | `check` | what is no light |

mod check;
mod drawn;
mod emission;
mod generator;
mod hammersley;
mod jittered;
mod lattice;
mod mesh;
mod shapes;
mod surface;
mod turn;
mod volume;

pub use check::takes_texture;
pub use generator::Generator;
pub use mesh::{points_light, surface_light, volume_light};
pub use turn::turned;

use drawn::Drawn;
use generator::Sequence;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Light, LightShape};

/// Most light samples of a light.
pub const MOST_SAMPLES: usize = 4096;

/// How a light is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// How the samples are spread.
    pub generator: Generator,
    /// How many, 1 to [`MOST_SAMPLES`].
    pub count: usize,
    /// Chooses among equally good sets, see [`Generator`].
    pub seed: u32,
}

impl Default for Sampling {
    /// One Hammersley point: the light's position.
    fn default() -> Self {
        Self { generator: Generator::Hammersley, count: 1, seed: 0 }
    }
}

impl Sampling {
    /// `count` Hammersley points.
    pub fn of_count(count: usize) -> Self {
        Self { count, ..Self::default() }
    }
}

/// Points on a light and the share of it that each carries.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSamples {
    /// World space.
    pub positions: Vec<[f32; 3]>,
    /// Linear RGB share; every channel sums to one.
    pub weights: Vec<[f32; 3]>,
    /// Linear RGB of the whole light: its colour times the mean of what its samples show.
    pub color: [f32; 3],
}

/// Samples of a light. All coincide where it has no extent.
///
/// # Errors
/// Numbers that are not finite or too large, no or too many samples, more samples than points, a texture on a shape without
/// (u, v), a light that emits nothing, a mesh without area or volume.
pub fn sample(light: &Light, sampling: &Sampling) -> Result<LightSamples, Problem> {
    let Sampling { generator, count, seed } = *sampling;
    if !(1..=MOST_SAMPLES).contains(&count) {
        return Err(Problem::new(Kind::BadValue, "no such number of light samples")
            .expected(format!("1 to {MOST_SAMPLES}"))
            .found(count.to_string()));
    }
    check::light(light)?;
    let sequence = Sequence { generator, seed, stream: 0 };
    let drawn = if count == 1 { vec![drawn::centre(light)] } else { drawn::draw(light, sequence, count)? };
    with_weights(light, &drawn)
}

/// `sets` disjoint sets of `sampling.count` samples: together they are the samples that the generator gives for all of them at once,
/// dealt out one to each set in turn. Every set has its own weights and colour, so that sets count alike.
///
/// # Errors
/// As [`sample`].
pub fn sample_sets(light: &Light, sampling: &Sampling, sets: usize) -> Result<Vec<LightSamples>, Problem> {
    let Sampling { generator, count, seed } = *sampling;
    let all = count.saturating_mul(sets);
    if !(1..=MOST_SAMPLES).contains(&count) || !(1..=MOST_SAMPLES).contains(&sets) {
        return Err(Problem::new(Kind::BadValue, "no such number of light samples and sets")
            .expected(format!("1 to {MOST_SAMPLES} each"))
            .found(format!("{sets} sets of {count}")));
    }
    check::light(light)?;
    let drawn = drawn::draw(light, Sequence { generator, seed, stream: 0 }, all)?;
    let dealt = |set: usize| drawn.iter().skip(set).step_by(sets).copied().collect::<Vec<_>>();
    (0..sets).map(|set| with_weights(light, &dealt(set))).collect()
}

fn with_weights(light: &Light, drawn: &[Drawn]) -> Result<LightSamples, Problem> {
    let (weights, mean) = emission::weights(drawn)?;
    let positions = drawn.iter().map(|drawn| drawn.position).collect();
    let color = [0, 1, 2].map(|channel| (f64::from(light.color[channel]) * mean[channel]) as f32);
    Ok(LightSamples { positions, weights, color })
}

/// Whether its samples can differ.
pub fn has_extent(light: &Light) -> bool {
    !matches!(light.shape, LightShape::Point) && light.radius > 0.0
}

#[cfg(test)]
mod tests;
