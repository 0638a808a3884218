//! The sum at one surface.

use super::light_shape;
use crate::ports;
use crate::shade::params::Settings;
use crate::shade::reflection::Reflection;
use crate::shade::surface::{Surface, picture};
use crate::shared::shading::unit;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// A light's samples and what a node makes of them.
pub struct LightSum<'a> {
    /// World space.
    pub samples: &'a [[f32; 3]],
    /// Linear RGB.
    pub weights: &'a [[f32; 3]],
    /// How surfaces reflect.
    pub reflection: Reflection,
    /// How distance weakens.
    pub settings: Settings,
}

impl LightSum<'_> {
    /// Light per channel that arrives in cosines, and in highlights; sums are made word by word of the mask.
    pub fn terms(&self, surface: &Surface, eye: Vec3, mask: &[u32]) -> [Vec3; 2] {
        let toward_eye = unit(eye - surface.position);
        let mut sums = [Vec3::ZERO; 2];
        for (word, blocked) in mask.iter().enumerate().filter(|(_, blocked)| **blocked != u32::MAX) {
            let mut of_word = [Vec3::ZERO; 2];
            let samples = (32 * word..self.samples.len().min(32 * (word + 1))).zip(0..);
            for (sample, _) in samples.filter(|(_, bit)| blocked >> bit & 1 == 0) {
                let offset = Vec3::from(self.samples[sample]) - surface.position;
                // Behind the surface itself no caster is needed.
                if offset.dot(surface.geometric_normal) > 0.0 {
                    let weight = Vec3::from(self.weights[sample]) / self.settings.weakening(offset);
                    let terms = self.reflection.terms(surface.shading_normal, unit(offset), toward_eye);
                    of_word[0] += weight * terms[0];
                    of_word[1] += weight * terms[1];
                }
            }
            sums[0] += of_word[0];
            sums[1] += of_word[1];
        }
        sums
    }
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let [_, words] = light_shape(|name| cx.optional(name).map(Array::shape))?;
    let sum = LightSum {
        samples: cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        weights: cx.input(input::LIGHT_WEIGHTS.name).as_vec3(),
        reflection: Reflection::new(cx.params()),
        settings: Settings::new(cx.params()),
    };
    let mask = cx.input(ports::MASK.name).as_u32();
    let eye = Vec3::from_slice(&cx.input(input::CAMERA.name).as_f32()[..3]);
    let color = Vec3::from_slice(&cx.input(input::LIGHT.name).as_f32()[4..7]);
    picture(cx, |row, surface| {
        let [cosines, highlights] = sum.terms(surface, eye, &mask[row * words..(row + 1) * words]);
        color * (surface.albedo * cosines + highlights)
    });
    Ok(())
}
