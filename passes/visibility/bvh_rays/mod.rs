//! `bvh_rays`: shadow rays (Whitted 1980). Every segment from a view-sample to a light sample is traced through a tree of boxes
//! until the first triangle hit, all in f32.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts), `light_samples [L 3]` world, any L, `position [P 3]` world,
//! `triangle [P]`, `sample_state [P]`. Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a view-sample facing away,
//! unused ones too, none for background.
//!
//! Tree and traversal are those of the obvhs crate. A ray runs from 0 at the view-sample to 1 at the light sample; there is no
//! bias: the view-sample's own triangle is left out by its index. The triangle test lets nothing through shared edges (a ray
//! that meets a corner exactly may still slip through), but it rounds: some bits in a million differ from the truth, where a
//! view-sample nearly touches another triangle. On coincident faces it fails: one shadows the other's view-samples, which the
//! truth's rule of the own plane rules out.
//!
//! CPU only: the tree is built there.

mod cpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "bvh_rays",
    stage: &STAGE,
    doc: "Shadow rays through a tree of boxes, in f32, without bias.",
    source: "Whitted 1980; Meister, Bittner 2018 (tree, by the obvhs crate)",
    ignores: &[
        "light_frame",
        "cell",
        "list_length",
        "list_far",
        "list_offset",
        "list_entries",
        "caster_offset",
        "caster_entries",
        "lu",
        "lu_layout",
    ],
    params: &[],
    counters: &[],
    contract: Contract::WrongBits(1e-3),
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: None,
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let words = mask_words(cx.dim(input::LIGHT_SAMPLES.name, 0));
    vec![(ports::MASK.name, vec![cx.dim(ports::POSITION.name, 0), words])]
}
