//! `silhouettes`: view-samples in cells that the influence region of a silhouette edge touches may see a part of the light; to all
//! others it has one answer, and one light sample gives it.
//!
//! Sintorn, Eisemann, Assarsson 2008, section 4.3, Restrict computations: penumbrae are cast by silhouette edges alone, which are those
//! that are a silhouette as seen from some point of the light.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `across [T 3]`, `light_samples [L 3]` world, `light_frame [F 20]`,
//! `position [P 3]` world, `triangle [P]`, `sample_state [P]`, `cell [P]`, `list_length [F S S]`, `list_far [F S S]` scene units.
//! Out: `penumbra_state [P]`: 1 where light samples may differ; 0 where they do not, and for background and what faces away.
//!
//! **Borders.** Let B be the convex hull of the light samples. A casting triangle is firm when all of B is surely on one side of its
//! plane. An edge is inner when the triangles on both of its sides are firm, wound alike and show B the same face. All other edges,
//! and triangles that are not firm with all that is on them, are borders. As S moves through B, the segment from P to S leaves a firm
//! triangle through an edge or a corner alone; through an inner one it goes on in the triangle across, and at a corner with inner edges
//! only the triangles around it close up. So where the segment meets no border its answer does not change, and where a segment can meet
//! one is the border's influence region ([`crate::shared::influence`], an edge being a triangle with two corners in one place).
//!
//! **The own triangle** is left out by every test, so its edges are borders to what lies on it: state 1 where the plane through the
//! view-sample and such an edge may cut B, which is within rounding of the edge, or where its own plane may. A view-sample in no cell
//! has state 1. Without triangles, light samples or view-samples every state is 0 and nothing is counted.
//!
//! **Superset.** Planes are decided by bounds on rounding, regions as `conservative_raster/influence` does. State 0 is exact on the
//! stored bits with one exception, the coplanar rule ([`crate::shared::predicate::OwnPlane`]): a view-sample that rounding has left
//! below its own plane, by no more than [`SUNK_ULPS`], sees no triangle that is wholly at or below that plane, and where an edge of
//! such a triangle of another mesh passes between it and its plane, light samples may differ by that much: the contact band
//! ([`crate::shared::contact`]). A view-sample further below has state 1.
//!
//! What it saves: passes of stage `visibility` decide planes for the whole light at once, and influence regions leave lit cells empty,
//! so only large umbrae of finely divided casters are left to win. The torus knot under a small light (radius 0.1, 256 light samples,
//! 512x512, CPU) spends 265 ms in place of 410 on visibility for 39 ms here; columns and Sponza under their own lights gain less than
//! this pass costs.
//!
//! Departs from the paper: the own triangle; triangles whose planes cut the light; the answer of view-samples, not of cells.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};
use shadowgraph_core::size::SizeCx;

/// A view-sample this many units in the last place of the largest coordinate below its own plane is there by rounding.
pub const SUNK_ULPS: f32 = 4.0;

/// The pass.
pub static PASS: Pass = Pass {
    name: "silhouettes",
    stage: &super::STAGE,
    doc: "Edges that are a silhouette for some point of the light, and the view-samples that may see the light past one.",
    source: "Sintorn 2008, section 4.3, Restrict computations; departs: the own triangle's edges",
    ignores: &[],
    params: &[],
    counters: &[
        Counter { name: "edges", doc: "edges of casting triangles", kind: CounterKind::Info },
        Counter {
            name: "silhouette_edges",
            doc: "edges that are a silhouette for some point of the light, open ones among them",
            kind: CounterKind::Info,
        },
        Counter { name: "cut_triangles", doc: "triangles whose planes may cut the light", kind: CounterKind::Info },
        Counter { name: "cells", doc: "cells with view-samples", kind: CounterKind::Info },
        Counter { name: "penumbra_cells", doc: "cells that a border's region touches", kind: CounterKind::Info },
        Counter {
            name: "partial_samples",
            doc: "view-samples to which light samples may differ",
            kind: CounterKind::Info,
        },
    ],
    contract: Contract::Superset,
    features: &[Feature::IndirectExecution],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::PENUMBRA_STATE.name, vec![cx.dim(ports::POSITION.name, 0)])]
}
