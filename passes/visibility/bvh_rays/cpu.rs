//! View-samples in chunks over threads; for each, one packet after another down the tree, nearer boxes first.

use super::own_plane::Plane;
use super::packet::{Lights, Packet, RAYS, Verdict};
use crate::ports;
use crate::shared::bvh::Bvh;
use crate::shared::segments::mask_words;
use crate::shared::threaded::{NODE_WORDS, Node};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, KEPT};
use std::sync::atomic::{AtomicU64, Ordering};

/// View-samples that one thread answers at a time.
const CHUNK_ROWS: usize = 256;

/// What is traced.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// Corners of every triangle, world space.
    pub triangles: &'a [[[f32; 3]; 3]],
    /// The tree over those that cast.
    pub nodes: &'a [[u32; NODE_WORDS]],
    /// Triangles in the order of its leaves.
    pub order: &'a [u32],
    /// Light samples, world space.
    pub light_samples: &'a [[f32; 3]],
    /// View-sample positions, world space.
    pub position: &'a [[f32; 3]],
    /// Triangle each lies on.
    pub triangle: &'a [u32],
    /// State of each.
    pub sample_state: &'a [u32],
}

/// Masks `[P, mask_words]`.
pub fn answer(scene: Scene, progress: &(dyn Fn(u64, u64) + Sync)) -> Vec<u32> {
    let words = mask_words(scene.light_samples.len());
    let mut masks = vec![0; scene.position.len() * words];
    if words == 0 {
        return masks;
    }
    let lights: Vec<Lights> = scene.light_samples.chunks(RAYS).map(Lights::new).collect();
    let (done, total) = (AtomicU64::new(0), scene.position.len() as u64);
    masks.par_chunks_mut(CHUNK_ROWS * words).enumerate().for_each(|(chunk, masks)| {
        rows(scene, &lights, chunk * CHUNK_ROWS, masks);
        let count = (masks.len() / words) as u64;
        progress(done.fetch_add(count, Ordering::Relaxed) + count, total);
    });
    masks
}

/// The masks of consecutive view-samples from `first` on, by the widest vectors there are.
fn rows(scene: Scene, lights: &[Lights], first: usize, masks: &mut [u32]) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        #[expect(unsafe_code, reason = "the processor has what the function is compiled for")]
        // SAFETY: checked in the line above.
        return unsafe { rows_avx2(scene, lights, first, masks) };
    }
    rows_any(scene, lights, first, masks);
}

/// As [`rows_any`], compiled for AVX2: the same operations, none of them contracted, so the same bits.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn rows_avx2(scene: Scene, lights: &[Lights], first: usize, masks: &mut [u32]) {
    rows_any(scene, lights, first, masks);
}

#[inline(always)]
fn rows_any(scene: Scene, lights: &[Lights], first: usize, masks: &mut [u32]) {
    let (mut packet, mut stack) = (Packet::new(), Vec::new());
    for (index, mask) in masks.chunks_exact_mut(mask_words(scene.light_samples.len())).enumerate() {
        let row = first + index;
        match scene.sample_state[row] {
            BACKGROUND => {}
            KEPT => {
                for ((place, lights), mask) in lights.iter().enumerate().zip(mask.chunks_mut(RAYS / 32)) {
                    if packet.aim(scene.position[row], lights) {
                        trace(scene, lights, place * RAYS, row, &mut packet, &mut stack);
                        for (word, mask) in mask.iter_mut().enumerate() {
                            *mask = packet.blocked(word);
                        }
                    }
                }
            }
            _ => mask.fill(u32::MAX),
        }
    }
}

/// Closes the lanes of `packet`, which leaves view-sample `row`, whose rays hit a caster.
#[inline(always)]
fn trace(scene: Scene, lights: &Lights, first_light: usize, row: usize, packet: &mut Packet, stack: &mut Vec<u32>) {
    let own = scene.triangle[row];
    let plane = scene.triangles.get(own as usize).map(Plane::new);
    let [low, high] = lights.bounds();
    let light_side = plane.as_ref().map_or(0, |plane| plane.side_of_box(low, high));
    stack.clear();
    if packet.enters(Node::of(scene.nodes, 0)).is_some() {
        stack.push(0);
    }
    // Every node on the stack is one that some ray may enter.
    while let Some(mut index) = stack.pop() {
        loop {
            let node = Node::of(scene.nodes, index);
            if let Some(places) = node.triangles() {
                for &id in &scene.order[places] {
                    if id == own {
                        continue;
                    }
                    let caster = &scene.triangles[id as usize];
                    let Some(seen) = packet.see(caster) else { continue };
                    let counts = |sample: usize| {
                        let light = scene.light_samples[first_light + sample];
                        plane.as_ref().is_none_or(|plane| plane.admits(caster, light, light_side))
                    };
                    match packet.judge(&seen) {
                        Verdict::Misses => {}
                        Verdict::Covers if light_side != 0 && counts(0) => {
                            packet.close_all();
                            return;
                        }
                        Verdict::Covers | Verdict::Open => {
                            if packet.close_hits(&seen, counts) {
                                return;
                            }
                        }
                    }
                }
                break;
            }
            let left = index + 1;
            let right = Node::of(scene.nodes, left).skip();
            match [left, right].map(|child| packet.enters(Node::of(scene.nodes, child))) {
                [Some(a), Some(b)] => {
                    let (near, far) = if a <= b { (left, right) } else { (right, left) };
                    stack.push(far);
                    index = near;
                }
                [Some(_), None] => index = left,
                [None, Some(_)] => index = right,
                [None, None] => break,
            }
        }
    }
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let triangles: &[[[f32; 3]; 3]] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let (built, built_order);
    let (nodes, order) = match (cx.optional(ports::BVH_NODES.name), cx.optional(ports::BVH_ORDER.name)) {
        (Some(nodes), Some(order)) => (nodes.as_u32().as_chunks().0, order.as_u32()),
        _ => {
            let caster_state = cx.input(ports::CASTER_STATE.name).as_u32();
            let bvh = Bvh::build(triangles, |id| caster_state[id] == 1);
            (built, built_order) = (bvh.threaded(), bvh.order().to_vec());
            (built.as_slice(), built_order.as_slice())
        }
    };
    let scene = Scene {
        triangles,
        nodes,
        order,
        light_samples: cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        position: cx.input(ports::POSITION.name).as_vec3(),
        triangle: cx.input(ports::TRIANGLE.name).as_u32(),
        sample_state: cx.input(ports::SAMPLE_STATE.name).as_u32(),
    };
    let shape = [scene.position.len(), mask_words(scene.light_samples.len())];
    let masks = answer(scene, cx.progress());
    cx.put(ports::MASK.name, Array::u32(shape, masks));
    Ok(())
}
