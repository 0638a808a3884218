//! `influence`: each caster's influence region on the light's image, cell by cell, into pairs: wherever it can hide any light
//! sample from any view-sample.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 4.1: a polygon of `sides` sides around the light's silhouette as seen from each corner of
//! the caster, projected through the corner onto the far plane, and the hull of the three, in linear time; lights that are no
//! balls by scaling space, planar ones directly. Lehtinen, Laine, Aila 2006: the light's side of the caster's plane is cut off. `quad`
//! after Eisemann, Decoret 2007: the bounding rectangle of the region and no more. The equations stand in
//! [`crate::shared::influence`].
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [L 3]` world, any L, `light_frame [F 20]`,
//! `list_length [F S S]`, `list_far [F S S]` scene units along the face's axis.
//! Out: `pair_cell`, `pair_slot`, `pair_caster` `[E]`, `caster_length [F S S]`, as of `binning`.
//!
//! Superset: every (cell, caster) pair with a view-sample of the cell from which the caster hides a light sample is there, whatever
//! rounding does. A caster that touches the light's bound goes to every cell of a face that it is not wholly beside. With
//! one light sample the region is the caster's footprint.
//!
//! Departs from the paper: cells are tightened by planes through the caster's edges that touch the light's bound, at the largest
//! depth of each cell; a caster with a corner nearer than the light's extent, or beside the face, has these planes alone. No
//! projection is drawn.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::{PAIRS, STAGE, pairs_size};
use crate::shared::hull::MOST_SIDES;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};

/// Values of `bound`.
const BOUNDS: [&str; 3] = ["sphere", "ellipsoid", "quad"];

/// The pass.
pub static PASS: Pass = Pass {
    name: "influence",
    stage: &STAGE,
    doc: "Walks the texels of each caster's influence region: umbra and penumbra of an area light.",
    source: "Sintorn 2008, section 4.1; Lehtinen, Laine, Aila 2006 (cut); Eisemann, Decoret 2007 (quad)",
    ignores: &[],
    params: &[
        ParamSpec {
            name: "sides",
            range: Range::U32 { min: 3, max: MOST_SIDES as u32, default: 6 },
            unit: "",
            doc: "sides of the polygon around the light's silhouette; more of them make regions tighter and their hulls dearer",
        },
        ParamSpec {
            name: "bound",
            range: Range::Word { words: &BOUNDS, default: "ellipsoid" },
            unit: "",
            doc: "what stands for a light that is not planar: a ball, an ellipsoid, tighter for long lights, or a ball whose \
                  regions are rectangles",
        },
        ParamSpec {
            name: "cut",
            range: Range::Bool { default: true },
            unit: "",
            doc: "cut off the part of a region on the light's side of the caster's plane; it is never blocked",
        },
    ],
    counters: &[
        PAIRS,
        Counter {
            name: "pairs_behind",
            doc: "pairs left out because every view-sample of the cell is nearer than the region",
            kind: CounterKind::Info,
        },
    ],
    contract: Contract::Superset,
    features: &[Feature::IndirectExecution],
    size: pairs_size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
