//! Sixteen view-samples against sixteen light samples: casters one by one, view-samples in the lanes of a register.
//!
//! For a caster with first corner a and edges e, f(v, s) = s . m - v . m with m = (a - v) x e: three products and sums a light sample
//! and edge once m is made. Edges that no segment of the shaft crosses are left out, and so is the caster's plane where it divides the
//! two groups. A segment within rounding of an edge or plane is decided by [`crate::shared::predicate::blocks`].

use super::LANES;
use super::shaft::{cross, dot_scalar};
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16};

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

/// For each light sample, a bit for each view-sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Found {
    /// Blocked for certain.
    pub sure: [u16; LANES],
    /// Blocked for certain, or in doubt.
    pub may: [u16; LANES],
}

/// What one caster does. `views` and `lights` are sixteen points each.
#[inline(always)]
pub fn test<S: Simd>(simd: S, views: [&[f32]; 3], lights: [&[f32]; 3], pair: &Pair) -> Found {
    let view = views.map(|along| f32x16::from_slice(simd, along));
    let [a, g, h] = pair.caster;
    if pair.side != 0 {
        let turn = f32::from(pair.side);
        let [g, h] = [g, h].map(|edge| edge.map(|x| turn * x));
        let sign = f32x16::splat(simd, 1.0);
        return edges(simd, view, lights, a, g, h, sign, pair);
    }
    // On which side of the caster's plane each view-sample and each light sample is.
    let normal = super::groups::cross(g, h);
    let height = |points: [f32x16<S>; 3]| dot_scalar(normal, [0, 1, 2].map(|k| points[k] - a[k]));
    let views_height = height(view);
    let lights_height = height(lights.map(|along| f32x16::from_slice(simd, along)));
    let below = |height: f32x16<S>| height.simd_lt(-pair.plane_error).to_bitmask() as u16;
    let above = |height: f32x16<S>| height.simd_gt(pair.plane_error).to_bitmask() as u16;
    let (view_below, view_above) = (below(views_height), above(views_height));
    let (light_below, light_above) = (below(lights_height), above(lights_height));
    let sign = f32x16::splat(simd, 1.0).copysign(-views_height);
    let mut found = edges(simd, view, lights, a, g, h, sign, pair);
    let in_plane = !(view_below | view_above);
    if in_plane != 0 {
        // Either side may be the right one.
        let other = edges(simd, view, lights, a, g, h, -sign, pair);
        for (may, other) in found.may.iter_mut().zip(other.may) {
            *may |= other & in_plane;
        }
    }
    for j in 0..LANES {
        let spread = |mask: u16| if mask >> j & 1 == 1 { u16::MAX } else { 0 };
        let (is_above, is_below) = (spread(light_above), spread(light_below));
        found.sure[j] &= (view_below & is_above) | (view_above & is_below);
        found.may[j] &= (!view_above & !is_below) | (!view_below & !is_above);
    }
    found
}

/// The edges alone; `sign` turns those of each view-sample.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "all of it in registers")]
fn edges<S: Simd>(
    simd: S,
    view: [f32x16<S>; 3],
    lights: [&[f32]; 3],
    a: [f32; 3],
    g: [f32; 3],
    h: [f32; 3],
    sign: f32x16<S>,
    pair: &Pair,
) -> Found {
    // Where `g` and `h` came turned, so does b here; any point of the line from b to c does for the third edge.
    let [true_a, true_g, _] = pair.caster;
    let b = [0, 1, 2].map(|k| true_a[k] + true_g[k]);
    let plane = |base: [f32; 3], edge: [f32; 3]| {
        let from = [0, 1, 2].map(|k| f32x16::splat(simd, base[k]) - view[k]);
        let m = cross(from, edge.map(|x| sign * x));
        let constant = -(view[0].mul_add(m[0], view[1].mul_add(m[1], view[2] * m[2])));
        [m[0], m[1], m[2], constant]
    };
    let first = || plane(a, g);
    let second = || plane(b, [0, 1, 2].map(|k| h[k] - g[k]));
    let third = || plane(a, h.map(|x| -x));
    let error = pair.edge_error;
    match pair.edges {
        0b001 => sides(simd, [first()], lights, error),
        0b010 => sides(simd, [second()], lights, error),
        0b100 => sides(simd, [third()], lights, error),
        0b011 => sides(simd, [first(), second()], lights, error),
        0b110 => sides(simd, [second(), third()], lights, error),
        0b101 => sides(simd, [first(), third()], lights, error),
        _ => sides(simd, [first(), second(), third()], lights, error),
    }
}

/// On the inner side of all planes.
#[inline(always)]
fn sides<S: Simd, const N: usize>(simd: S, planes: [[f32x16<S>; 4]; N], lights: [&[f32]; 3], error: f32) -> Found {
    let mut found = Found::default();
    let (inside, outside) = (f32x16::splat(simd, error), f32x16::splat(simd, -error));
    let [x, y, z] = lights.map(|along| &along[..LANES]);
    for j in 0..LANES {
        let height =
            |plane: [f32x16<S>; 4]| plane[0].mul_add(x[j], plane[1].mul_add(y[j], plane[2].mul_add(z[j], plane[3])));
        let mut lowest = height(planes[0]);
        for plane in &planes[1..] {
            lowest = lowest.min(height(*plane));
        }
        found.sure[j] = lowest.simd_gt(inside).to_bitmask() as u16;
        found.may[j] = lowest.simd_ge(outside).to_bitmask() as u16;
    }
    found
}
