//! The smallest cosine over the corners of a box.

use crate::bent_light::around;
use crate::shared::shading::unit;
use glam::Vec3;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// Smallest and largest coordinates of `points`; none without points.
pub fn bounds(points: &[[f32; 3]]) -> Option<[Vec3; 2]> {
    let (first, rest) = points.split_first()?;
    let first = Vec3::from(*first);
    Some(rest.iter().map(|point| Vec3::from(*point)).fold([first; 2], |[low, high], at| [low.min(at), high.max(at)]))
}

/// The smallest cosine between a face's normal and the directions from `at` to the corners of a box.
pub fn cosine(normal: Vec3, at: Vec3, [low, high]: [Vec3; 2]) -> f32 {
    let corner = |bits: u32| {
        let pick = |axis: usize| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] };
        Vec3::new(pick(0), pick(1), pick(2))
    };
    (0..8).map(|bits| unit(corner(bits) - at).dot(normal)).fold(f32::INFINITY, f32::min)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let light = bounds(cx.input(input::LIGHT_SAMPLES.name).as_vec3());
    around::run(cx, |normal, at| light.map_or(0.0, |light| cosine(normal, at, light)));
    Ok(())
}
