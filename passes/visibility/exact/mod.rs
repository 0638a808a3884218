//! `exact`: the truth. Every segment from a view-sample to a light sample against every triangle that could block it, decided
//! by exact predicates on the stored f32 values.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts), `light_samples [L 3]` world, any L, `position [P 3]` world,
//! `triangle [P]`, `sample_state [P]`. Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a view-sample facing away,
//! unused ones too, none for background.
//!
//! The judge is [`crate::shared::predicate::blocks`]. A tree of boxes leaves out triangles that certainly miss the segment
//! ([`crate::shared::bvh`]); the answer is that of a search over all triangles, bit for bit, whatever the tree, the threads
//! or the order. A view-sample's own triangle is left out by its index; there is no bias of any kind.
//!
//! `contact` counts view-samples in the contact band ([`crate::shared::contact`]): those whose answer a move of
//! `contact_ulps` units in the last place could turn. It says nothing against the answer, which holds for the stored bits.
//!
//! CPU only: no GPU has the arithmetic.

mod cpu;
#[cfg(test)]
mod tests;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "exact",
    stage: &STAGE,
    doc: "The truth: exact orientation predicates on the stored values, over a padded tree of boxes.",
    source: "Shewchuk 1997 (predicates); Sintorn 2008, section 3.3 (test); departs: no lists",
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
        "bvh_nodes",
        "bvh_order",
        "penumbra_state",
    ],
    params: &[ParamSpec {
        name: "contact_ulps",
        range: Range::F32 { min: 0.0, max: 1024.0, default: 1.0 },
        unit: "units in the last place",
        doc: "half width of the counted contact band; 0 counts nothing and is a third faster; never changes the mask",
    }],
    counters: &[
        Counter {
            name: "candidates",
            doc: "(segment, triangle) pairs that boxes let through",
            kind: CounterKind::Info,
        },
        Counter { name: "contact", doc: "view-samples in the contact band", kind: CounterKind::Info },
    ],
    contract: Contract::Exact,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: None,
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let words = mask_words(cx.dim(input::LIGHT_SAMPLES.name, 0));
    vec![(ports::MASK.name, vec![cx.dim(ports::POSITION.name, 0), words])]
}
