//! `fused_draw`: each caster's grown outline through the rasteriser; its fragments test the view-samples of their cell.
//!
//! Sintorn, Eisemann, Assarsson 2008, sections 3.2 and 3.3, in the paper's own form: conservative rasterisation by six vertices a caster,
//! and a fragment program that walks the list of its texel. The paper combines casters by the logic operations of blending, 1024
//! view-samples a pass; here fragments set one word a view-sample.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [1 3]` world, `light_frame [F 20]`, `position [P 3]` world,
//! `triangle [P]`, `sample_state [P]`, `cell [P]`, and the lists of view-samples by cell.
//! Out: `mask [P 1]`, bit 0 set = blocked; all bits set for a view-sample facing away, none for background.
//!
//! A fragment walks no more of a list than a shader may loop; longer lists are counted, and an error. Takes one light sample; more is
//! an error.

mod gpu;

use super::STAGE;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "fused_draw",
    stage: &STAGE,
    doc: "Draws each caster grown by half a texel; fragments test the view-samples listed there.",
    source: "Sintorn 2008, sections 3.2 and 3.3",
    ignores: &[
        "normal",
        "caster_offset",
        "caster_entries",
        "lu",
        "lu_layout",
        "bvh_nodes",
        "bvh_order",
        "penumbra_state",
    ],
    params: &[],
    counters: &[
        Counter {
            name: "exact_pairs",
            doc: "(view-sample, caster) pairs that only arithmetic of two floats could decide",
            kind: CounterKind::Info,
        },
        Counter {
            name: "untested",
            doc: "fragments whose list is longer than they can walk",
            kind: CounterKind::MustBeZero("give the light frame more texels, or use visibility: fused"),
        },
    ],
    contract: Contract::WrongBits(1e-5),
    features: &[Feature::FragmentWritableStorage],
    size,
    cpu: None,
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![("mask", vec![cx.dim("position", 0), 1])]
}
