//! The walk of every segment, and its judge.

use crate::ports;
use crate::shared::bvh::{Bvh, Walk};
use crate::shared::contact::{Verdict, step, verdict};
use crate::shared::predicate::{Corners, OwnPlane, Pyramid};
use crate::shared::segments::{mask_words, masks};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// What the answers are a function of.
#[derive(Clone, Copy)]
pub struct Receivers<'a> {
    /// Corners of every triangle, world space.
    pub triangles: &'a [Corners],
    /// 1 for each triangle that casts.
    pub caster_state: &'a [u32],
    /// Light samples, world space.
    pub light_samples: &'a [[f32; 3]],
    /// View-sample positions, world space.
    pub position: &'a [[f32; 3]],
    /// Triangle each lies on.
    pub triangle: &'a [u32],
    /// State of each.
    pub sample_state: &'a [u32],
}

/// Masks, and what was counted.
#[derive(Debug, PartialEq)]
pub struct Answer {
    /// `[P, mask_words]`.
    pub masks: Vec<u32>,
    /// (segment, triangle) pairs tested.
    pub candidates: u64,
    /// View-samples in the contact band.
    pub contact: u64,
}

/// What one thread keeps and counts.
#[derive(Default)]
struct Worker {
    walk: Walk,
    candidates: u64,
    contact: u64,
    last_contact: Option<usize>,
}

/// The truth for all view-samples.
pub fn answer(scene: Receivers, contact_ulps: f32, progress: &(dyn Fn(u64, u64) + Sync)) -> Answer {
    let bvh = Bvh::build(scene.triangles, |id| scene.caster_state[id] == 1);
    let (masks, workers) =
        masks(scene.sample_state, scene.light_samples.len(), progress, |worker: &mut Worker, row, sample| {
            segment(scene, &bvh, contact_ulps, worker, row, sample)
        });
    Answer {
        masks,
        candidates: workers.iter().map(|worker| worker.candidates).sum(),
        contact: workers.iter().map(|worker| worker.contact).sum(),
    }
}

/// Whether light sample `sample` is blocked at view-sample `row`.
fn segment(scene: Receivers, bvh: &Bvh, contact_ulps: f32, worker: &mut Worker, row: usize, sample: usize) -> bool {
    let (position, light, own) = (scene.position[row], scene.light_samples[sample], scene.triangle[row]);
    let own_corners = scene.triangles.get(own as usize);
    let own_plane = own_corners.map(|own| OwnPlane::new(own, light));
    let counts_contact = contact_ulps > 0.0;
    let step_with = |points: &[[f32; 3]]| step(contact_ulps, points.iter().chain([&position, &light]));
    let pad = if counts_contact { step_with(&bvh.extremes()) } else { 0.0 };
    let (mut blocked, mut firm, mut close) = (false, false, false);
    let candidates = &mut worker.candidates;
    bvh.along_segment(&mut worker.walk, position, light, pad, |id| {
        if id == own {
            return false;
        }
        *candidates += 1;
        let caster = &scene.triangles[id as usize];
        blocked = blocked
            || (Pyramid::new(caster, light).covers(position) && own_plane.is_none_or(|plane| plane.admits(caster)));
        if !counts_contact {
            return blocked;
        }
        match verdict(position, own_corners, caster, light, step_with(caster)) {
            Verdict::Blocks => firm = true,
            Verdict::Close => close = true,
            Verdict::Clear => {}
        }
        firm
    });
    if close && !firm && worker.last_contact != Some(row) {
        worker.last_contact = Some(row);
        worker.contact += 1;
    }
    blocked
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let scene = Receivers {
        triangles: bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32()),
        caster_state: cx.input(ports::CASTER_STATE.name).as_u32(),
        light_samples: cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        position: cx.input(ports::POSITION.name).as_vec3(),
        triangle: cx.input(ports::TRIANGLE.name).as_u32(),
        sample_state: cx.input(ports::SAMPLE_STATE.name).as_u32(),
    };
    let Answer { masks, candidates, contact } = answer(scene, cx.params().f32("contact_ulps"), cx.progress());
    let shape = [scene.position.len(), mask_words(scene.light_samples.len())];
    cx.put(ports::MASK.name, Array::u32(shape, masks));
    cx.count("candidates", candidates);
    cx.count("contact", contact);
    Ok(())
}
