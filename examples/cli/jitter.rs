//! Jitter: neighbouring pixels ask other samples of the same light, so that what is left of banding becomes noise (Sintorn 2008,
//! section 4.2). A square pattern of pixels repeats over the picture; each place in it has a sample set of its own.

use crate::usage_problem;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::Light;
use shadowgraph_scenes::lights::{LightSamples, Sampling, sample, turned};

/// Where the sets come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Jitter {
    /// One set for all pixels
    #[default]
    None,
    /// The set turned about the light's axis of symmetry
    Turn,
    /// Sets of other seeds
    Seed,
}

/// Pixels a side of the pattern.
pub const SIDES: [u32; 3] = [2, 4, 8];

/// The set of the pixel at column and row: neighbours differ most (ordered dither of `side`, a power of two).
pub fn set_of(column: usize, row: usize, side: usize) -> usize {
    let bits = side.trailing_zeros();
    let (x, y) = (column % side, row % side);
    (0..bits).fold(0, |set, bit| {
        let (x, y) = (x >> bit & 1, y >> bit & 1);
        set << 2 | (x ^ y) << 1 | y
    })
}

/// Side squared sets; the first is `base`.
///
/// # Errors
/// A light that cannot be turned, or what [`sample`] reports; a side that is no pattern's.
pub fn sets(
    jitter: Jitter,
    side: u32,
    light: &Light,
    sampling: &Sampling,
    base: &LightSamples,
) -> Result<Vec<LightSamples>, Problem> {
    if jitter == Jitter::None {
        return Ok(vec![base.clone()]);
    }
    if !SIDES.contains(&side) {
        return Err(usage_problem("--jitter-side is no pattern").expected("2, 4 or 8 pixels").found(side.to_string()));
    }
    let count = (side * side) as usize;
    let set = |index: usize| match jitter {
        Jitter::Turn => Ok(LightSamples { positions: turned(light, &base.positions, index, count)?, ..base.clone() }),
        _ if index == 0 => Ok(base.clone()),
        _ => sample(light, &Sampling { seed: sampling.seed.wrapping_add(index as u32), ..*sampling }),
    };
    (0..count).map(set).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_of_the_pattern_has_a_set_of_its_own() {
        for side in SIDES.map(|side| side as usize) {
            let mut sets: Vec<usize> = (0..side * side).map(|pixel| set_of(pixel % side, pixel / side, side)).collect();
            assert_eq!(set_of(0, 0, side), 0);
            assert_eq!(set_of(side + 1, 3 * side, side), set_of(1, 0, side));
            sets.sort_unstable();
            assert!(sets.into_iter().eq(0..side * side));
        }
        assert_eq!([(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| set_of(x, y, 2)), [0, 2, 3, 1]);
    }

    #[test]
    fn seeds_give_other_sets_of_the_same_light() {
        let light = Light::sphere("light", [0.0; 3], 1.0);
        let sampling = Sampling::of_count(32);
        let base = sample(&light, &sampling).expect("samples");
        for jitter in [Jitter::Turn, Jitter::Seed] {
            let sets = sets(jitter, 2, &light, &sampling, &base).expect("sets");
            assert_eq!((sets.len(), &sets[0]), (4, &base));
            assert!(sets[1..].iter().all(|set| set.positions != base.positions));
        }
    }
}
