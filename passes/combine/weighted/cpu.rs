//! Weights of the light samples whose bits are not set.

use super::check_weights;
use crate::ports;
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::BACKGROUND;

/// View-samples one task takes.
const CHUNK: usize = 1 << 12;

/// Luminance of linear RGB, ITU-R BT.709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Weights, and what 32 of them sum to.
pub struct Weights<'a> {
    of_sample: &'a [[f32; 3]],
    of_word: Vec<Vec3>,
    /// All of them.
    pub total: Vec3,
}

impl<'a> Weights<'a> {
    /// Of light samples in order.
    pub fn new(of_sample: &'a [[f32; 3]]) -> Self {
        let mut weights = Self { of_sample, of_word: Vec::new(), total: Vec3::ZERO };
        weights.of_word = (0..of_sample.len().div_ceil(32)).map(|word| weights.lit_of_word(word, 0)).collect();
        weights.total = weights.of_word.iter().fold(Vec3::ZERO, |sum, word| sum + *word);
        weights
    }

    fn lit_of_word(&self, word: usize, blocked: u32) -> Vec3 {
        let samples = self.of_sample[32 * word..].iter().take(32).enumerate();
        let lit = samples.filter(|(bit, _)| blocked >> bit & 1 == 0);
        lit.fold(Vec3::ZERO, |sum, (_, weight)| sum + Vec3::from(*weight))
    }

    /// Sum of the weights whose bit is clear.
    pub fn lit(&self, mask: &[u32]) -> Vec3 {
        let of_word = |(word, blocked): (usize, &u32)| match *blocked {
            0 => self.of_word[word],
            u32::MAX => Vec3::ZERO,
            blocked => self.lit_of_word(word, blocked),
        };
        mask.iter().enumerate().map(of_word).fold(Vec3::ZERO, |sum, word| sum + word)
    }

    /// The share of the luminance in `lit`; 1 where there is none to share.
    pub fn share(&self, lit: Vec3) -> f32 {
        let (lit, all) = (luminance(lit), luminance(self.total));
        if lit == all { 1.0 } else { lit / all }
    }
}

fn luminance(color: Vec3) -> f32 {
    LUMINANCE.x * color.x + LUMINANCE.y * color.y + LUMINANCE.z * color.z
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let (mask, states) = (cx.input(ports::MASK.name), cx.input(ports::SAMPLE_STATE.name).as_u32());
    let rows = cx.input(input::LIGHT_WEIGHTS.name).as_vec3();
    let words = mask.dim(1);
    check_weights(rows.len(), words)?;
    let (weights, masks) = (Weights::new(rows), mask.as_u32());
    let lit_at = |(index, state): (usize, &u32)| {
        if *state == BACKGROUND { weights.total } else { weights.lit(&masks[index * words..(index + 1) * words]) }
    };
    let lit: Vec<[f32; 3]> =
        states.par_iter().enumerate().with_min_len(CHUNK).map(|row| lit_at(row).to_array()).collect();
    let visible: Vec<f32> = lit.iter().map(|lit| weights.share(Vec3::from(*lit))).collect();
    cx.put(ports::VISIBLE.name, Array::f32([visible.len()], visible));
    cx.put(ports::VISIBLE_COLOR.name, Array::f32([lit.len(), 3], bytemuck::cast_vec(lit)));
    Ok(())
}
