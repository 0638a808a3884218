//! One ray after another.

use crate::ports;
use crate::shared::bvh::topology;
use crate::shared::segments::{mask_words, masks};
use glam::Vec3A;
use obvhs::ray::Ray;
use obvhs::triangle::Triangle;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// Boxes grow by this share of the largest coordinate, about 4 units in the last place, on top of a millionth of the scene:
/// a ray that nearly follows an axis is given a slope of 2^-23 by obvhs, which must not lead it out of a box it runs along.
const WIDEN_UNIT: f32 = 5e-7;

/// A power of two that brings the largest coordinate to 1..2 and rounds nothing. Without it, areas of boxes and products in
/// the triangle test overflow on 1e38, and obvhs takes directions below 1e-7 for none.
fn unit_scale<'a>(points: impl Iterator<Item = &'a [f32; 3]>) -> f64 {
    let largest = points.flatten().filter(|x| x.is_finite()).fold(0.0f32, |largest, x| largest.max(x.abs()));
    if largest > 0.0 { 2f64.powi(-(f64::from(largest).log2().floor() as i32)) } else { 1.0 }
}

/// Masks `[P, mask_words]`.
pub fn answer(
    triangles: &[[[f32; 3]; 3]],
    caster_state: &[u32],
    light_samples: &[[f32; 3]],
    position: &[[f32; 3]],
    triangle: &[u32],
    sample_state: &[u32],
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Vec<u32> {
    let scale = unit_scale(triangles.iter().flatten().chain(light_samples).chain(position));
    let unit = |p: [f32; 3]| p.map(|x| (f64::from(x) * scale) as f32);
    let usable = |id: usize| caster_state[id] == 1 && triangles[id].iter().flatten().all(|x| x.is_finite());
    let kept: Vec<u32> = (0..triangles.len()).filter(|&id| usable(id)).map(|id| id as u32).collect();
    let units: Vec<_> = kept.iter().map(|&id| triangles[id as usize].map(unit)).collect();
    let tree = topology(&units, WIDEN_UNIT);
    // In the order of the leaves.
    let leaves: Vec<(u32, Triangle)> = tree
        .primitive_indices
        .iter()
        .map(|&place| {
            let [v0, v1, v2] = units[place as usize].map(Vec3A::from);
            (kept[place as usize], Triangle { v0, v1, v2 })
        })
        .collect();
    let rays = |_: &mut (), row: usize, sample: usize| {
        let (from, to) = (Vec3A::from(unit(position[row])), Vec3A::from(unit(light_samples[sample])));
        if !(from.is_finite() && to.is_finite()) {
            return false;
        }
        // A hit at 0 is a triangle whose plane holds the view-sample, which is seen edge-on.
        let ray = Ray::new(from, to - from, f32::MIN_POSITIVE, 1.0);
        // obvhs takes a hit at tmax for a miss; no triangle is hit past it.
        !tree.ray_traverse_miss(Ray { tmax: 1.0f32.next_up(), ..ray }, |_, place| {
            let (id, corners) = &leaves[place];
            if *id == triangle[row] { f32::INFINITY } else { corners.intersect(&ray) }
        })
    };
    masks(sample_state, light_samples.len(), progress, rays).0
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let light_samples = cx.input(input::LIGHT_SAMPLES.name).as_vec3();
    let position = cx.input(ports::POSITION.name).as_vec3();
    let masks = answer(
        bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32()),
        cx.input(ports::CASTER_STATE.name).as_u32(),
        light_samples,
        position,
        cx.input(ports::TRIANGLE.name).as_u32(),
        cx.input(ports::SAMPLE_STATE.name).as_u32(),
        cx.progress(),
    );
    cx.put(ports::MASK.name, Array::u32([position.len(), mask_words(light_samples.len())], masks));
    Ok(())
}
