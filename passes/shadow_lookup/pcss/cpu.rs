//! View-sample by view-sample: blockers, penumbra, filter.

use super::taps::spiral;
use crate::ports;
use crate::shared::light_frame::faces;
use crate::shared::segments::mask_words;
use crate::shared::shadow_lookup::{Lookup, Map, Placed, SLOPE_CAP, bias, place, seen};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, KEPT};

/// What is the same for every view-sample.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Biases; one texel a tap.
    pub lookup: Lookup,
    /// Radius of the light, scene units.
    pub light_radius: f32,
    /// Depth of the nearest blocker that is sought in full, over the view-sample's.
    pub nearest_blocker: f32,
    /// Largest radius, share of the map's side.
    pub largest_width: f32,
    /// Taps in the unit disc.
    pub search: Vec<[f32; 2]>,
    /// Taps in the unit disc.
    pub filter: Vec<[f32; 2]>,
}

impl Settings {
    /// From the parameters and the light's radius.
    pub fn new(params: &Params, light_radius: f32) -> Self {
        let taps = |name: &str| spiral(params.u32(name) as usize);
        Self {
            lookup: super::super::settings(params, 1),
            light_radius,
            nearest_blocker: params.f32(super::NEAREST_BLOCKER.name),
            largest_width: params.f32(super::LARGEST_WIDTH.name),
            search: taps(super::SEARCH_TAPS.name),
            filter: taps(super::FILTER_TAPS.name),
        }
    }
}

/// A receiver and the map about it.
struct Around<'a> {
    map: Map<'a>,
    placed: Placed,
    bias: f32,
    /// Change of 1 / depth of the receiver's plane with u and v.
    slope: [f32; 2],
}

impl Around<'_> {
    /// Depth the map holds at (u, v) from the receiver, where that is nearer to the light than the receiver's plane there.
    fn blocker(&self, u: f32, v: f32) -> Option<f32> {
        let face = &self.map.faces[self.placed.point.face];
        let column = ((self.placed.point.u + u - face.window_low[0]) / self.placed.pitch[0]).floor();
        let row = ((self.placed.point.v + v - face.window_low[1]) / self.placed.pitch[1]).floor();
        let seen = seen(self.map, self.placed.point.face, column, row);
        // The receiver's plane at the tap, within the cap of a slope.
        let depth = self.placed.point.depth;
        let texels = (u / self.placed.pitch[0]).abs() + (v / self.placed.pitch[1]).abs();
        let cap = SLOPE_CAP * self.placed.width * texels;
        let nearness = 1.0 / depth + self.slope[0] * u + self.slope[1] * v;
        let plane = if nearness > 0.0 { (1.0 / nearness).clamp(depth - cap, depth + cap) } else { depth + cap };
        (seen < plane - self.bias).then_some(seen)
    }
}

/// Share of the light that the view-sample sees, 0..=1.
pub fn visible(map: Map, settings: &Settings, position: Vec3, normal: Vec3) -> f32 {
    let Some(placed) = place(map, settings.lookup, position, normal) else { return 1.0 };
    let face = &map.faces[placed.point.face];
    let height = placed.toward.dot(face.origin - position).abs().max(1e-20);
    let slope = [face.axis_x, face.axis_y].map(|axis| -placed.toward.dot(axis) / height);
    let around = Around { map, placed, bias: bias(map, settings.lookup, &placed), slope };
    let depth = placed.point.depth;
    let largest = [0, 1].map(|k| settings.largest_width * face.window_size[k]);
    let radius = |blocker: f32| settings.light_radius * (1.0 / blocker - 1.0 / depth);

    let reach = radius(settings.nearest_blocker * depth);
    let [reach_u, reach_v] = largest.map(|largest| reach.min(largest));
    let (mut sum, mut count) = (0.0, 0);
    for [x, y] in &settings.search {
        if let Some(blocker) = around.blocker(reach_u * x, reach_v * y) {
            sum += blocker;
            count += 1;
        }
    }
    if count == 0 {
        return 1.0;
    }
    let penumbra = radius(sum / count as f32).max(0.0);
    let [width_u, width_v] = [0, 1].map(|k| penumbra.min(largest[k]).max(0.5 * placed.pitch[k]));
    let lit = settings.filter.iter().filter(|[x, y]| around.blocker(width_u * x, width_v * y).is_none()).count();
    lit as f32 / settings.filter.len() as f32
}

/// Writes so many of the lowest of `light_count` bits that their share is that of the light not seen, rounded.
pub fn set_bits(mask: &mut [u32], light_count: usize, visible: f32) {
    let blocked = ((1.0 - visible) * light_count as f32 + 0.5).floor() as usize;
    for (word, mask) in mask.iter_mut().enumerate() {
        let bits = blocked.saturating_sub(32 * word);
        *mask = if bits >= 32 { u32::MAX } else { (1 << bits) - 1 };
    }
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let settings = Settings::new(cx.params(), cx.input(input::LIGHT.name).as_f32()[3]);
    let depth = cx.input(ports::DEPTH.name);
    let faces = faces(cx.input(ports::LIGHT_FRAME.name).as_f32());
    let map = Map { faces: &faces, depth: depth.as_f32(), side: depth.dim(1) };
    let (position, normal) = (cx.input(ports::POSITION.name).as_vec3(), cx.input(ports::NORMAL.name).as_vec3());
    let states = cx.input(ports::SAMPLE_STATE.name).as_u32();
    let light_count = cx.input(input::LIGHT_SAMPLES.name).dim(0);
    let words = mask_words(light_count);
    let mut shares = vec![1.0; states.len()];
    shares.par_iter_mut().enumerate().for_each(|(row, share)| match states[row] {
        BACKGROUND => {}
        KEPT => *share = visible(map, &settings, Vec3::from(position[row]), Vec3::from(normal[row])),
        _ => *share = 0.0,
    });
    let mut masks = vec![0; states.len() * words];
    for ((mask, share), state) in masks.chunks_exact_mut(words.max(1)).zip(&shares).zip(states) {
        match *state {
            BACKGROUND => {}
            KEPT => set_bits(mask, light_count, *share),
            _ => mask.fill(u32::MAX),
        }
    }
    cx.put(ports::MASK.name, Array::u32([states.len(), words], masks));
    cx.put(ports::VISIBLE.name, Array::f32([shares.len()], shares));
    Ok(())
}
