//! Sixteen view-samples against sixteen light samples: casters one by one, view-samples in the lanes of a register.
//!
//! For a caster with first corner a and edges e, f(v, s) = s . m - v . m with m = (a - v) x e: three products and sums a light sample
//! and edge once m is made. Edges that no segment of the shaft crosses are left out, and so is the caster's plane where it divides the
//! two groups. A segment within rounding of an edge or plane is decided by [`crate::shared::predicate::blocks`].

use super::LANES;
use super::groups::LightBox;
use super::shaft::{Vector, abs, cross, dot, dot_one, from, load};
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x16, u32x16};

/// A caster at a leaf.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pair {
    /// First corner and edges.
    pub caster: [[f32; 3]; 3],
    /// Bound on the error of an edge's function.
    pub edge_error: f32,
    /// Bound on the error of the plane's.
    pub plane_error: f32,
    /// Edges that matter, a bit each.
    pub edges: u8,
    /// 1: seen from below for certain, -1: from above, 0: not certain.
    pub side: i8,
}

/// For each view-sample, a bit for each light sample.
#[derive(Clone, Copy)]
pub struct Found<S: Simd> {
    /// Blocked for certain.
    pub sure: u32x16<S>,
    /// Blocked for certain, or in doubt.
    pub may: u32x16<S>,
}

/// What one caster does. `views` and `lights` are sixteen points each.
#[inline(always)]
pub fn test<S: Simd>(simd: S, views: [&[f32]; 3], lights: [&[f32]; 3], pair: &Pair) -> Found<S> {
    let view = [load(simd, views[0], 0), load(simd, views[1], 0), load(simd, views[2], 0)];
    let [a, g, h] = pair.caster;
    if pair.side != 0 {
        let sign = f32x16::splat(simd, f32::from(pair.side));
        return edges(simd, view, lights, sign, pair);
    }
    // On which side of the caster's plane each view-sample and each light sample is.
    let normal = super::groups::cross(g, h);
    let light = [load(simd, lights[0], 0), load(simd, lights[1], 0), load(simd, lights[2], 0)];
    let views_height = dot_one(normal, from(view, a));
    let lights_height = dot_one(normal, from(light, a));
    let (low, high) = (-pair.plane_error, pair.plane_error);
    let view_below = views_height.simd_lt(low);
    let view_above = views_height.simd_gt(high);
    let light_below = lights_height.simd_lt(low).to_bitmask() as u32;
    let light_above = lights_height.simd_gt(high).to_bitmask() as u32;
    let zero = f32x16::splat(simd, 0.0);
    let sign = f32x16::splat(simd, 1.0).copysign(zero - views_height);
    let mut found = edges(simd, view, lights, sign, pair);
    let in_plane = !(view_below | view_above);
    let (none, all) = (u32x16::splat(simd, 0), u32x16::splat(simd, u32::MAX));
    if in_plane.any_true() {
        // Either side may be the right one.
        let other = edges(simd, view, lights, zero - sign, pair);
        found.may |= in_plane.select(other.may, none);
    }
    let (not_below, not_above) = (u32x16::splat(simd, !light_below), u32x16::splat(simd, !light_above));
    let from_below = view_below.select(u32x16::splat(simd, light_above), none);
    found.sure &= from_below | view_above.select(u32x16::splat(simd, light_below), none);
    found.may &= (view_above.select(none, all) & not_below) | (view_below.select(none, all) & not_above);
    found
}

/// View-samples for which the caster may block some light sample of a box: each one's own cone, not the group's.
#[inline(always)]
pub fn open_lanes<S: Simd>(simd: S, views: [&[f32]; 3], light: &LightBox, pair: &Pair) -> u16 {
    let view = [load(simd, views[0], 0), load(simd, views[1], 0), load(simd, views[2], 0)];
    let [a, g, h] = pair.caster;
    let mut middle = [0.0; 3];
    let mut half = [0.0; 3];
    for k in 0..3 {
        middle[k] = 0.5 * (light.low[k] + light.high[k]);
        half[k] = 0.5 * (light.high[k] - light.low[k]) * (1.0 + 1e-6);
    }
    let normal = super::groups::cross(g, h);
    let views_height = dot_one(normal, from(view, a));
    let below = views_height.simd_lt(-pair.plane_error).to_bitmask() as u16;
    let above = views_height.simd_gt(pair.plane_error).to_bitmask() as u16;
    let light_height = super::groups::dot(normal, [middle[0] - a[0], middle[1] - a[1], middle[2] - a[2]]);
    let light_spread = super::groups::dot([normal[0].abs(), normal[1].abs(), normal[2].abs()], half) + pair.plane_error;
    let mut misses = 0;
    if light_height + light_spread < 0.0 {
        misses |= below;
    }
    if light_height - light_spread > 0.0 {
        misses |= above;
    }
    let b = [a[0] + g[0], a[1] + g[1], a[2] + g[2]];
    let between = [h[0] - g[0], h[1] - g[1], h[2] - g[2]];
    let bases = [a, b, a];
    let lines = [g, between, [-h[0], -h[1], -h[2]]];
    let sign = f32x16::splat(simd, 1.0);
    let (mut negative, mut positive) = (0, 0);
    for k in 0..3 {
        let plane = plane(view, bases[k], lines[k], sign);
        let spread = dot_one(half, abs([plane[0], plane[1], plane[2]])) + pair.edge_error;
        let at = height(&plane, middle[0], middle[1], middle[2]);
        negative |= (at + spread).simd_lt(0.0).to_bitmask() as u16;
        positive |= (at - spread).simd_gt(0.0).to_bitmask() as u16;
    }
    !(misses | (negative & positive) | (below & negative) | (above & positive))
}

/// The edges alone; `sign` turns those of each view-sample.
#[inline(always)]
fn edges<S: Simd>(simd: S, view: Vector<S>, lights: [&[f32]; 3], sign: f32x16<S>, pair: &Pair) -> Found<S> {
    let [a, g, h] = pair.caster;
    let b = [a[0] + g[0], a[1] + g[1], a[2] + g[2]];
    let between = [h[0] - g[0], h[1] - g[1], h[2] - g[2]];
    let error = pair.edge_error;
    let back = [-h[0], -h[1], -h[2]];
    match pair.edges {
        0b001 => sides(simd, [plane(view, a, g, sign)], lights, error),
        0b010 => sides(simd, [plane(view, b, between, sign)], lights, error),
        0b100 => sides(simd, [plane(view, a, back, sign)], lights, error),
        0b011 => sides(simd, [plane(view, a, g, sign), plane(view, b, between, sign)], lights, error),
        0b110 => sides(simd, [plane(view, b, between, sign), plane(view, a, back, sign)], lights, error),
        0b101 => sides(simd, [plane(view, a, g, sign), plane(view, a, back, sign)], lights, error),
        _ => {
            let three = [plane(view, a, g, sign), plane(view, b, between, sign), plane(view, a, back, sign)];
            sides(simd, three, lights, error)
        }
    }
}

/// Through each view-sample and the edge: normal and constant.
#[inline(always)]
fn plane<S: Simd>(view: Vector<S>, base: [f32; 3], edge: [f32; 3], sign: f32x16<S>) -> [f32x16<S>; 4] {
    let to = from(view, base);
    // (base - v) x e = e x (v - base)
    let m = cross([sign * edge[0], sign * edge[1], sign * edge[2]], to);
    let constant = dot(view, m);
    [m[0], m[1], m[2], constant]
}

/// On the inner side of all planes.
#[inline(always)]
fn sides<S: Simd, const N: usize>(simd: S, planes: [[f32x16<S>; 4]; N], lights: [&[f32]; 3], error: f32) -> Found<S> {
    let mut found = Found { sure: u32x16::splat(simd, 0), may: u32x16::splat(simd, 0) };
    let (inside, outside) = (f32x16::splat(simd, error), f32x16::splat(simd, -error));
    let (x, y, z) = (&lights[0][..LANES], &lights[1][..LANES], &lights[2][..LANES]);
    for j in 0..LANES {
        let mut lowest = height(&planes[0], x[j], y[j], z[j]);
        for plane in &planes[1..] {
            lowest = lowest.min(height(plane, x[j], y[j], z[j]));
        }
        let bit = 1 << j;
        found.sure = lowest.simd_gt(inside).select(found.sure | bit, found.sure);
        found.may = lowest.simd_ge(outside).select(found.may | bit, found.may);
    }
    found
}

/// Sixteen masks of a bit for each of sixteen, the other way about.
#[inline(always)]
pub fn transposed<S: Simd>(masks: u32x16<S>) -> [u16; LANES] {
    let mut turned = [0; LANES];
    for (j, turned) in turned.iter_mut().enumerate() {
        *turned = (masks & (1 << j)).simd_ne(0).to_bitmask() as u16;
    }
    turned
}

/// Of one light sample above a plane of each view-sample.
#[inline(always)]
fn height<S: Simd>(plane: &[f32x16<S>; 4], x: f32, y: f32, z: f32) -> f32x16<S> {
    plane[0].mul_add(x, plane[1].mul_add(y, plane[2].mul_sub(z, plane[3])))
}
