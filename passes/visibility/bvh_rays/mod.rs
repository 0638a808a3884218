//! `bvh_rays`: shadow rays (Whitted 1980). Every segment from a view-sample to a light sample is traced through a tree of boxes
//! until the first triangle hit, all in f32.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts), `light_samples [L 3]` world, any L, `position [P 3]` world,
//! `triangle [P]`, `sample_state [P]`, `bvh_nodes [N 8]` and `bvh_order [T]` in the form of [`crate::shared::threaded`]; without them
//! the CPU builds a tree of its own, and wgpu refuses. Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a
//! view-sample facing away, unused ones too, none for background.
//!
//! A ray runs from 0 at the view-sample to 1 at the light sample; there is no bias. The view-sample's own triangle is left out by
//! its index, and a hit only counts if some corner of its triangle is above the view-sample's own plane, on the light's side
//! (`admits` of [`crate::shared::predicate`], as exact as the backend has it): faces that lie in one another cast no shadow on
//! one another. The triangle test lets nothing through shared edges (a ray that meets a corner exactly may still slip through),
//! but it rounds: some bits in a million differ from the truth, where a view-sample nearly touches another triangle.
//!
//! On the CPU the rays of a view-sample go together, up to [`packet::RAYS`] of them: a box or triangle that the cone of all of
//! them misses costs one test. On wgpu a ray is an invocation, which walks without a stack and takes at most [`gpu::RAY_STEPS`] steps;
//! rays cut there are counted (`unfinished`), and any is an error.

mod cpu;
mod gpu;
mod own_plane;
mod packet;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// Rays that are not done.
const UNFINISHED: Counter = Counter {
    name: "unfinished",
    doc: "rays that met more boxes and triangles than one invocation may visit",
    kind: CounterKind::MustBeZero("set `on: Cpu` for this node"),
};

/// The pass.
pub static PASS: Pass = Pass {
    name: "bvh_rays",
    stage: &STAGE,
    doc: "Shadow rays through a tree of boxes, in f32, without bias.",
    source: "Whitted 1980; Boulos et al. 2007 (interval tests of packets)",
    ignores: &[
        "light_frame",
        "normal",
        "cell",
        "list_length",
        "list_far",
        "list_offset",
        "list_entries",
        "caster_offset",
        "caster_entries",
        "lu",
        "lu_layout",
        "penumbra_state",
    ],
    params: &[],
    counters: &[UNFINISHED],
    contract: Contract::WrongBits(1e-3),
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let words = mask_words(cx.dim(input::LIGHT_SAMPLES.name, 0));
    vec![(ports::MASK.name, vec![cx.dim(ports::POSITION.name, 0), words])]
}
