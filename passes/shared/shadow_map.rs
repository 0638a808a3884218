//! The shadow map's depth: how it is stored, how it is read back, how coarse it is. The passes that draw a map and those
//! that look it up share this file.
//!
//! A face's map spans its window, from `far * NEAR_SHARE` to `far`, the largest depth of its view-samples: what lies further
//! hides none of them. Casters nearer than the near plane are lost, a thousandth of the way to the furthest view-sample.
//! Stored is the rasteriser's own hyperbolic depth `d = far / (far - near) (1 - near / w)` of depth w along the face's axis,
//! linear over a triangle in the map; 1 means that nothing was seen. [`step`] is what four units in the last place of
//! d near 1 are in scene units: `w^2 / near` 2^-22, at w = far some 2.4e-4 of far. Two do for arithmetic that rounds once; a device
//! that interpolates over a large triangle needs more.

use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::GpuCx;

/// The map's declarations and readers in WGSL, joined after `light_frame::WGSL`.
pub const WGSL: &str = include_str!("shadow_map.wgsl");

/// Near plane over far plane: a power of two, small enough for casters close to the light, each halving doubles [`step`].
pub const NEAR_SHARE: f32 = 1.0 / 1024.0;

/// Depth units a second surface lies behind the first at least: four units in the last place near 1.
pub const SECOND_STEP: f32 = 1.0 / (1 << 22) as f32;

/// Depth 0..1 at `w` along the axis of a face whose furthest view-sample is at `far`.
#[inline]
pub fn depth_from_linear(w: f32, far: f32) -> f32 {
    let near = far * NEAR_SHARE;
    far / (far - near) * (1.0 - near / w)
}

/// Depth along the axis, scene units, where `depth` is stored; infinite at 1.
#[inline]
pub fn linear_from_depth(depth: f32, far: f32) -> f32 {
    if depth >= 1.0 {
        return f32::INFINITY;
    }
    let near = far * NEAR_SHARE;
    near * far / (far - depth * (far - near))
}

/// How far rounding of the stored depth may move a surface at `w`, scene units.
#[inline]
pub fn step(w: f32, far: f32) -> f32 {
    w * w / (far * NEAR_SHARE) * (1.0 / (1 << 22) as f32)
}

/// The side that the parameter called `name` gives, if the device has textures of that size.
///
/// # Errors
/// A side above the device's limit.
pub fn side_on_device(cx: &GpuCx, name: &'static str) -> Result<u32, Problem> {
    let (side, limit) = (cx.params().u32(name), cx.limits().texture_side);
    if side > limit {
        return Err(Problem::new(Kind::Unsupported, "the shadow map is larger than the device's largest texture")
            .port(name)
            .expected(format!("at most {limit}"))
            .found(side.to_string())
            .remedy("set a smaller size, or `on: Cpu` for this node"));
    }
    Ok(side)
}

#[cfg(test)]
#[path = "shadow_map_tests.rs"]
mod tests;
