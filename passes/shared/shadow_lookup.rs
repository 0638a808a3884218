//! Looking a view-sample up in the shadow map: bias, taps, share of taps that see the light.
//!
//! The view-sample is moved along its normal, on the light's side, by `normal_offset` texels; it then falls in a face and a
//! texel. Of the k x k texels about that one, a tap is lit when the moved view-sample is not further along the face's axis than
//! what the texel holds plus the bias: `bias_constant` scene units, plus `bias_slope` times the growth in depth of the
//! view-sample's own plane over half a kernel, plus the step of the stored depth ([`crate::shared::shadow_map::step`]). At
//! `bias_slope` 1 a plane does not shadow itself. The growth is cut at [`SLOPE_CAP`] texels' width: a plane seen edge-on
//! would need all bias there is. Taps outside the map are lit.

use crate::shared::light_frame::{Face, project};
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

/// Share of the taps that see the light, 0..=1.
pub fn visible(map: Map, lookup: Lookup, position: Vec3, normal: Vec3) -> f32 {
    let Some(first) = project(map.faces, position) else { return 1.0 };
    let face = &map.faces[first.face];
    let pitch = [face.window_size[0] / map.side as f32, face.window_size[1] / map.side as f32];
    let toward = if normal.dot(face.origin - position) < 0.0 { -normal } else { normal };
    let texel_width = first.depth * pitch[0].max(pitch[1]);
    let moved = position + toward * (lookup.normal_offset * texel_width);
    let Some(point) = project(map.faces, moved) else { return 1.0 };
    let face = &map.faces[point.face];
    let pitch = [face.window_size[0] / map.side as f32, face.window_size[1] / map.side as f32];

    // Growth of the plane's depth w = n . P / (n . (u x + v y + z)) over a texel in u and in v.
    let along = (toward.dot(moved - face.origin) / point.depth).abs();
    let across = (toward.dot(face.axis_x) * pitch[0]).abs() + (toward.dot(face.axis_y) * pitch[1]).abs();
    let width = point.depth * pitch[0].max(pitch[1]);
    let growth = (point.depth * across).min(SLOPE_CAP * width * along) / along.max(1e-20);
    let bias =
        lookup.bias_constant + lookup.bias_slope * 0.5 * lookup.kernel as f32 * growth + step(point.depth, face.far);

    let column = ((point.u - face.window_low[0]) / pitch[0]).floor();
    let row = ((point.v - face.window_low[1]) / pitch[1]).floor();
    let last = map.side as f32 - 1.0;
    let layer = &map.depth[point.face * map.side * map.side..][..map.side * map.side];
    let reach = (lookup.kernel / 2) as f32;
    let mut lit = 0;
    for tap in 0..lookup.kernel * lookup.kernel {
        let column = column + (tap % lookup.kernel) as f32 - reach;
        let row = row + (tap / lookup.kernel) as f32 - reach;
        let is_inside = column >= 0.0 && column <= last && row >= 0.0 && row <= last;
        let seen = if is_inside {
            linear_from_depth(layer[row as usize * map.side + column as usize], face.far)
        } else {
            f32::INFINITY
        };
        lit += u32::from(point.depth - bias <= seen);
    }
    lit as f32 / (lookup.kernel * lookup.kernel) as f32
}

#[cfg(test)]
#[path = "shadow_lookup_tests.rs"]
mod tests;
