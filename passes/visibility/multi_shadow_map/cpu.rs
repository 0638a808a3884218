//! Range by range: faces and maps of its light samples, then all view-samples.

use super::ranges;
use crate::ports;
use crate::shared::light_fit::refit;
use crate::shared::light_frame::{Face, faces};
use crate::shared::segments::mask_words;
use crate::shared::shadow_lookup::{Lookup, Map, visible};
use crate::shared::shadow_raster::{CLEAR, draw};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::{BACKGROUND, KEPT};

/// View-samples of a rayon task.
const CHUNK_ROWS: usize = 1024;
/// Most memory that maps take.
const MOST_BYTES: u64 = 1 << 31;

/// What the masks are a function of.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// Corners of every triangle, world space.
    pub triangles: &'a [[[f32; 3]; 3]],
    /// 1 for each triangle that casts.
    pub caster_state: &'a [u32],
    /// Light samples, world space.
    pub light_samples: &'a [[f32; 3]],
    /// Faces whose axes every light sample takes over.
    pub faces: &'a [Face],
    /// View-sample positions, world space.
    pub position: &'a [[f32; 3]],
    /// Their normals.
    pub normal: &'a [[f32; 3]],
    /// State of each.
    pub sample_state: &'a [u32],
}

/// Masks `[P, mask_words]`, and the number of (kept view-sample, light sample) pairs that no face places.
pub fn answer(
    scene: Scene,
    side: usize,
    at_once: usize,
    lookup: Lookup,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> (Vec<u32>, u64) {
    let light_count = scene.light_samples.len();
    let words = mask_words(light_count);
    let full = |state: &u32| if *state == BACKGROUND || *state == KEPT { 0 } else { u32::MAX };
    let mut masks: Vec<u32> =
        scene.sample_state.iter().flat_map(|state| std::iter::repeat_n(full(state), words)).collect();
    let map_texels = scene.faces.len() * side * side;
    let mut depth = vec![CLEAR; at_once.min(light_count) * map_texels];
    let mut behind = 0;
    for range in ranges(light_count, at_once) {
        progress(range.start as u64, light_count as u64);
        let maps: Vec<(Vec<Face>, u64)> = scene.light_samples[range.clone()]
            .par_iter()
            .zip(depth.par_chunks_mut(map_texels.max(1)))
            .map(|(light_sample, depth)| {
                let (faces, behind) = refit(scene.faces, Vec3::from(*light_sample), scene.position, scene.sample_state);
                depth.fill(CLEAR);
                for (face, layer) in faces.iter().zip(depth.chunks_exact_mut(side * side)) {
                    draw(face, side, scene.triangles, scene.caster_state, layer, |_, _| true);
                }
                (faces, behind)
            })
            .collect();
        behind += maps.iter().map(|(_, behind)| behind).sum::<u64>();
        let maps: Vec<Map> = maps
            .iter()
            .zip(depth.chunks_exact(map_texels.max(1)))
            .map(|((faces, _), depth)| Map { faces, depth, side })
            .collect();
        let (word, first_bit) = (range.start / 32, range.start % 32);
        masks.par_chunks_mut(CHUNK_ROWS * words).enumerate().for_each(|(chunk, masks)| {
            for (index, mask) in masks.chunks_exact_mut(words).enumerate() {
                let row = chunk * CHUNK_ROWS + index;
                if scene.sample_state[row] != KEPT {
                    continue;
                }
                let (position, normal) = (Vec3::from(scene.position[row]), Vec3::from(scene.normal[row]));
                for (bit, map) in (first_bit..).zip(&maps) {
                    mask[word] |= u32::from(visible(*map, lookup, position, normal) < 0.5) << bit;
                }
            }
        });
    }
    (masks, behind)
}

/// Refuses maps of `at_once` light samples that take more than [`MOST_BYTES`].
///
/// # Errors
/// Names needed and available bytes, and what to set to what.
pub fn check_bytes(face_count: usize, side: u32, at_once: usize) -> Result<(), Problem> {
    let faces = face_count.max(1) as u64;
    let bytes = (4 * faces * u64::from(side).pow(2)).saturating_mul(at_once as u64);
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    let (name, most) = match at_once {
        0 | 1 => (super::SIZE.name, (MOST_BYTES / (4 * faces)).isqrt()),
        _ => (super::MEMORY.name, MOST_BYTES >> 20),
    };
    Err(Problem::new(Kind::Unsupported, "the shadow maps are too large")
        .port(name)
        .expected(format!("at most {MOST_BYTES} bytes"))
        .found(format!("{bytes} bytes for {at_once} x {faces} maps of {side} x {side} texels"))
        .remedy(format!("set `{name}` to {most} or less")))
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let faces = faces(cx.input(ports::LIGHT_FRAME.name).as_f32());
    let scene = Scene {
        triangles: bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32()),
        caster_state: cx.input(ports::CASTER_STATE.name).as_u32(),
        light_samples: cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        faces: &faces,
        position: cx.input(ports::POSITION.name).as_vec3(),
        normal: cx.input(ports::NORMAL.name).as_vec3(),
        sample_state: cx.input(ports::SAMPLE_STATE.name).as_u32(),
    };
    let side = cx.params().u32(super::SIZE.name);
    let at_once = super::at_once(cx.params(), faces.len());
    check_bytes(faces.len(), side, at_once.min(scene.light_samples.len()))?;
    let (masks, behind) = answer(scene, side as usize, at_once, super::lookup(cx.params()), cx.progress());
    let shape = [scene.position.len(), mask_words(scene.light_samples.len())];
    cx.put(ports::MASK.name, Array::u32(shape, masks));
    cx.count(super::BEHIND.name, behind);
    Ok(())
}
