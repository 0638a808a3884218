//! One ray after another.

use crate::ports;
use crate::shared::bvh::topology;
use crate::shared::segments::{mask_words, masks};
use glam::Vec3A;
use obvhs::ray::Ray;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// Boxes grow by this share of the largest coordinate, about 4 units in the last place, on top of a millionth of the scene:
/// a ray that nearly follows an axis is given a slope of 2^-23 by obvhs, which must not lead it out of a box it runs along.
const WIDEN_UNIT: f32 = 5e-7;

/// Whether the segment from `from` along `along` meets the closed triangle after its start and not after its end.
///
/// Corners are taken from `from`, and an edge's side of the segment is a product that changes its sign, and nothing else, when
/// the edge is walked the other way: what passes a shared edge hits one of its triangles, rounded as it may be.
#[inline]
fn meets(from: Vec3A, along: Vec3A, corners: &[Vec3A; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner - from);
    let sides = [along.dot(a.cross(b)), along.dot(b.cross(c)), along.dot(c.cross(a))];
    if !(sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)) {
        return false;
    }
    let whole = sides[0] + sides[1] + sides[2];
    let height = a.dot((corners[1] - corners[0]).cross(corners[2] - corners[0]));
    if whole > 0.0 { height > 0.0 && height <= whole } else { height < 0.0 && height >= whole }
}

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
    let leaves: Vec<(u32, [Vec3A; 3])> = tree
        .primitive_indices
        .iter()
        .map(|&place| (kept[place as usize], units[place as usize].map(Vec3A::from)))
        .collect();
    let rays = |_: &mut (), row: usize, sample: usize| {
        let (from, to) = (Vec3A::from(unit(position[row])), Vec3A::from(unit(light_samples[sample])));
        if !(from.is_finite() && to.is_finite()) {
            return false;
        }
        let along = to - from;
        // obvhs takes what enters a box or hits at the largest distance for a miss.
        let ray = Ray::new(from, along, 0.0, 1.0f32.next_up());
        !tree.ray_traverse_miss(ray, |_, place| {
            let (id, corners) = &leaves[place];
            if *id != triangle[row] && meets(from, along, corners) { 0.0 } else { f32::INFINITY }
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
