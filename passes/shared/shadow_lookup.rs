//! Looking a view-sample up in the shadow map: bias, taps, share of taps that see the light.
//!
//! The view-sample is moved along its normal, on the light's side, by `normal_offset` texels; it then falls in a face and a
//! texel. Of the k x k texels about that one, a tap is lit when the moved view-sample is not further along the face's axis than
//! what the texel holds plus the bias: `bias_constant` scene units, plus `bias_slope` times the growth in depth of the
//! view-sample's own plane over half a kernel, plus the step of the stored depth ([`crate::shared::shadow_map::step`]). At
//! `bias_slope` 1 a plane does not shadow itself. The growth is cut at [`SLOPE_CAP`] texels' width: a plane seen edge-on
//! would need all bias there is. Taps outside the map are lit.

use crate::shared::light_frame::{Face, Projected, project};
use crate::shared::shadow_map::{linear_from_depth, step};
use glam::Vec3;
use shadowgraph_core::param::{ParamSpec, Range};

/// The lookup in WGSL, joined after `shadow_map::WGSL`.
pub const WGSL: &str = include_str!("shadow_lookup.wgsl");

/// Most growth of depth over one texel that the slope bias follows, in texel widths: a plane within 0.9 degrees of edge-on.
pub const SLOPE_CAP: f32 = 64.0;

/// Parameters of every lookup.
pub const BIAS_CONSTANT: ParamSpec = ParamSpec {
    name: "bias_constant",
    range: Range::F32 { min: -1e6, max: 1e6, default: 0.0 },
    unit: "scene units along the face's axis",
    doc: "fewer surfaces shadow themselves as it grows, and shadows part further from their casters",
};
/// Slope-scaled bias.
pub const BIAS_SLOPE: ParamSpec = ParamSpec {
    name: "bias_slope",
    range: Range::F32 { min: 0.0, max: 64.0, default: 1.0 },
    unit: "half kernels of the receiver's own slope",
    doc: "1 keeps planes from shadowing themselves; more helps curved ones, and parts shadows on grazing receivers from their casters",
};
/// Normal offset.
pub const NORMAL_OFFSET: ParamSpec = ParamSpec {
    name: "normal_offset",
    range: Range::F32 { min: 0.0, max: 64.0, default: 0.0 },
    unit: "texels at the view-sample's depth",
    doc: "fewer surfaces shadow themselves as it grows, and shadows move sideways by as much",
};

/// One lookup's settings.
#[derive(Clone, Copy, Debug)]
pub struct Lookup {
    /// Scene units along the face's axis.
    pub bias_constant: f32,
    /// Times the plane's growth over half a kernel.
    pub bias_slope: f32,
    /// Texels along the normal.
    pub normal_offset: f32,
    /// Taps a side, odd.
    pub kernel: u32,
}

/// A map to look up in.
#[derive(Clone, Copy, Debug)]
pub struct Map<'a> {
    /// Its faces.
    pub faces: &'a [Face],
    /// `[F, side, side]`.
    pub depth: &'a [f32],
    /// Texels a side.
    pub side: usize,
}

/// A view-sample moved along its normal, as a face of a map sees it.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// Where.
    pub point: Projected,
    /// Extent of a texel in u and v.
    pub pitch: [f32; 2],
    /// The view-sample's normal, on the light's side.
    pub toward: Vec3,
    /// Distance of the face's origin from the view-sample's plane, over its depth.
    pub along: f32,
    /// A texel's larger side at the view-sample's depth, scene units.
    pub width: f32,
}

/// Where a view-sample falls; none where no face sees it, which is lit.
#[inline]
pub fn place(map: Map, lookup: Lookup, position: Vec3, normal: Vec3) -> Option<Placed> {
    let first = project(map.faces, position)?;
    let face = &map.faces[first.face];
    let pitch = [face.window_size[0] / map.side as f32, face.window_size[1] / map.side as f32];
    let toward = if normal.dot(face.origin - position) < 0.0 { -normal } else { normal };
    let texel_width = first.depth * pitch[0].max(pitch[1]);
    let moved = position + toward * (lookup.normal_offset * texel_width);
    let point = project(map.faces, moved)?;
    let face = &map.faces[point.face];
    let pitch = [face.window_size[0] / map.side as f32, face.window_size[1] / map.side as f32];
    let along = (toward.dot(moved - face.origin) / point.depth).abs();
    Some(Placed { point, pitch, toward, along, width: point.depth * pitch[0].max(pitch[1]) })
}

/// Bias of a square of `lookup.kernel` texels a side, scene units.
#[inline]
pub fn bias(map: Map, lookup: Lookup, placed: &Placed) -> f32 {
    // Growth of the plane's depth w = n . P / (n . (u x + v y + z)) over a texel in u and in v.
    let face = &map.faces[placed.point.face];
    let across = (placed.toward.dot(face.axis_x) * placed.pitch[0]).abs()
        + (placed.toward.dot(face.axis_y) * placed.pitch[1]).abs();
    let depth = placed.point.depth;
    let growth = (depth * across).min(SLOPE_CAP * placed.width * placed.along) / placed.along.max(1e-20);
    lookup.bias_constant + lookup.bias_slope * 0.5 * lookup.kernel as f32 * growth + step(depth, face.far)
}

/// Depth that the map holds in a texel, given as whole numbers, of a face; infinite outside the map.
#[inline]
pub fn seen(map: Map, face: usize, column: f32, row: f32) -> f32 {
    let last = map.side as f32 - 1.0;
    let is_inside = column >= 0.0 && column <= last && row >= 0.0 && row <= last;
    if !is_inside {
        return f32::INFINITY;
    }
    let texel = (face * map.side + row as usize) * map.side + column as usize;
    linear_from_depth(map.depth[texel], map.faces[face].far)
}

/// Share of the taps that see the light, 0..=1.
#[inline]
pub fn visible(map: Map, lookup: Lookup, position: Vec3, normal: Vec3) -> f32 {
    let Some(placed) = place(map, lookup, position, normal) else { return 1.0 };
    let bias = bias(map, lookup, &placed);
    let Placed { point, pitch, .. } = placed;
    let low = map.faces[point.face].window_low;
    let column = ((point.u - low[0]) / pitch[0]).floor();
    let row = ((point.v - low[1]) / pitch[1]).floor();
    let reach = (lookup.kernel / 2) as f32;
    let mut lit = 0;
    for tap in 0..lookup.kernel * lookup.kernel {
        let column = column + (tap % lookup.kernel) as f32 - reach;
        let row = row + (tap / lookup.kernel) as f32 - reach;
        lit += u32::from(point.depth - bias <= seen(map, point.face, column, row));
    }
    lit as f32 / (lookup.kernel * lookup.kernel) as f32
}

#[cfg(test)]
#[path = "shadow_lookup_tests.rs"]
mod tests;
