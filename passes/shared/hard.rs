//! What the passes of hard visibility share: their inputs, own planes, and the way from blocked bits to a mask.

use super::light_frame::Face;
use super::predicate::{Corners, OwnPlane, Pyramid};
use super::receivers::{LANES, Receivers};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::{FACING_AWAY, NO_TRIANGLE};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Inputs of a hard visibility pass.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// Corners of every triangle.
    pub triangles: &'a [Corners],
    /// The light sample.
    pub light: [f32; 3],
    /// Position of every view-sample.
    pub position: &'a [[f32; 3]],
    /// Triangle of every view-sample.
    pub triangle: &'a [u32],
}

/// Answers about own planes, kept from one view-sample to the next: neighbours mostly lie on one triangle.
#[derive(Clone, Copy, Debug)]
pub struct OwnMemo {
    own: u32,
    admits: bool,
}

impl Default for OwnMemo {
    fn default() -> Self {
        Self { own: NO_TRIANGLE, admits: true }
    }
}

impl Scene<'_> {
    /// Whether triangle `caster` may shadow points of triangle `own`.
    #[inline]
    pub fn admits(&self, memo: &mut OwnMemo, own: u32, caster: &Corners) -> bool {
        if memo.own != own {
            let plane = self.triangles.get(own as usize).map(|corners| OwnPlane::new(corners, self.light));
            *memo = OwnMemo { own, admits: plane.is_none_or(|plane| plane.admits(caster)) };
        }
        memo.admits
    }

    /// Whether any of `casters` blocks view-sample `sample`, exactly.
    pub fn is_blocked(&self, sample: u32, casters: impl Iterator<Item = u32>) -> bool {
        let (own, position) = (self.triangle[sample as usize], self.position[sample as usize]);
        casters.filter(|caster| *caster != own).any(|caster| {
            let corners = &self.triangles[caster as usize];
            Pyramid::new(corners, self.light).covers(position) && self.admits(&mut OwnMemo::default(), own, corners)
        })
    }
}

impl<'a> Scene<'a> {
    /// From the ports `triangles`, `light_samples`, `position` and `triangle`.
    ///
    /// # Errors
    /// More or fewer than one light sample; a light frame that looks from elsewhere.
    pub fn new(cx: &CpuCx<'a>, faces: &[Face]) -> Result<Self, Problem> {
        let lights = cx.input("light_samples").as_vec3();
        let [light] = *lights else {
            return Err(Problem::new(Kind::BadValue, "a hard shadow has one light sample")
                .port("light_samples")
                .expected("1 light sample")
                .found(format!("{} light samples", lights.len()))
                .remedy("use a graph for soft shadows, or one light sample"));
        };
        if let Some(face) = faces.iter().find(|face| face.origin.to_array() != light) {
            return Err(Problem::new(Kind::BadValue, "the light frame does not look from the light sample")
                .port("light_frame")
                .expected(format!("origin {light:?}"))
                .found(format!("origin {:?}", face.origin.to_array())));
        }
        Ok(Self {
            triangles: bytemuck::cast_slice(cx.input("triangles").as_f32()),
            light,
            position: cx.input("position").as_vec3(),
            triangle: cx.input("triangle").as_u32(),
        })
    }
}

impl Scene<'_> {
    /// The wild view-samples of `receivers` that a casting triangle blocks.
    pub fn blocked_wild(&self, receivers: &Receivers, caster_state: &[u32]) -> Vec<u32> {
        let casters = || (0..self.triangles.len() as u32).filter(|caster| caster_state[*caster as usize] != 0);
        let wild = receivers.wild.par_iter().copied();
        wild.filter(|sample| self.is_blocked(*sample, casters())).collect()
    }
}

/// The mask `[P 1]`: full where `sample_state` says facing away, else bit 0 from the table's blocked bits and `wild_blocked`.
pub fn mask(receivers: &Receivers, sample_state: &[u32], wild_blocked: &[u32]) -> Array {
    let base = |state: &u32| AtomicU32::new(if *state == FACING_AWAY { u32::MAX } else { 0 });
    let mask: Vec<AtomicU32> = sample_state.par_iter().with_min_len(1 << 14).map(base).collect();
    for face in &receivers.faces {
        let [start, end] = face.places;
        let blocked = &receivers.blocked[start / LANES..end.div_ceil(LANES)];
        let lists = receivers.entries[start - face.shift..end - face.shift].par_chunks(LANES);
        lists.zip(blocked).with_min_len(1 << 10).for_each(|(list, blocked)| {
            let blocked = blocked.load(Relaxed);
            for (lane, sample) in list.iter().enumerate() {
                if blocked >> lane & 1 == 1 {
                    // Each view-sample is listed once, so no two threads meet here.
                    mask[*sample as usize].store(1, Relaxed);
                }
            }
        });
    }
    let mut words: Vec<u32> = mask.into_iter().map(AtomicU32::into_inner).collect();
    for sample in &receivers.wild {
        words[*sample as usize] = 0;
    }
    for sample in wild_blocked {
        words[*sample as usize] = 1;
    }
    Array::u32([words.len(), 1], words)
}
