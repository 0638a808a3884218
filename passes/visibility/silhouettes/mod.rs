//! `silhouettes`: how many casters stand before a light sample is counted once a view-sample, and changes only across edges.
//!
//! Laine, Aalto, Kontkanen, Lehtinen, Seppälä 2005 and Forest, Barthe, Paulin 2008 count depth complexity by silhouettes; here in the
//! lists of Sintorn, Eisemann, Assarsson 2008, section 4, and for meshes of any topology.
//!
//! For a view-sample v let D(l) be the number of casters that the segment from v to light sample l meets; l is blocked when D(l) > 0. As
//! l moves, D changes only where the segment meets an edge whose casters do not balance, by the edge's **jump**: those with their third
//! corner on one side of the plane of v and the edge, less those with it on the other. Inner edges of a surface balance, silhouettes
//! give 2, open borders 1, edges of three triangles what they give. Neither orientation nor topology is asked for.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [L 3]` world, `position [P 3]` world, `triangle [P]`,
//! `sample_state [P]`, `cell [P]`, lists of view-samples (`list_offset`, `list_entries`) and of casters (`caster_offset`,
//! `caster_entries`) by cell.
//! Out: `mask [P ceil(L/32)]`, bit set = blocked; all bits set for a view-sample facing away, none for background.
//! It equals [`crate::shared::predicate::blocks`] bit for bit, given casters that hold all that matter.
//!
//! The way of a cell, in parts of view-samples that lie close together (`worker`):
//! 1. its casters in the shaft to the light, from its own origin, sixteen to a block (`cell`); edges have one number for all their
//!    casters (`edges`);
//! 2. for each triangle that its view-samples lie on, the casters that its plane lets through (`own`); where the light is on both sides of
//!    that plane, each side is counted apart;
//! 3. casters that have one facing for the whole part are joined: edges between them are dropped, and D of them follows from one view-sample
//!    to the next by the borders that are left (`borders`, `ask`);
//! 4. for each view-sample, the borders and the other casters near the light's cone (`meet`): one caster that hides all of the light
//!    ends the work;
//! 5. D is known at the light sample nearest the light's middle, and each edge with a jump adds it to the light samples behind the
//!    edge (`count`).
//!
//! A caster that may reach as far as the light is tested alone, as in `half_planes`. A light sample that rounding cannot tell from a
//! border is decided by the predicate; where the chosen light sample is one of those another is chosen.
//!
//! Why so, with figures of two threads of an AVX-512 machine, bunny and knots at 512x512:
//! - the planes of a small caster's edges nearly all cut the light's ball, however far off it lies: one plane that touches the cone beside it
//!   leaves a quarter of the edges;
//! - where the own plane cuts the light, to test alone what it lets through on one side costs more than to count each side apart;
//! - parts of 32 view-samples in place of whole cells leave a twentieth of the casters that have no facing for all;
//! - sheets end the work on a quarter of the view-samples that edges would cross.
//!
//! Departs from the papers: any topology, exact, and a step of one light sample at a time in place of spans.

mod ask;
mod borders;
mod cell;
mod count;
mod cpu;
mod edges;
mod meet;
mod own;
#[cfg(test)]
mod tests;
mod worker;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// Casters that a register holds.
const LANES: usize = 16;

const fn info(name: &'static str, doc: &'static str) -> Counter {
    Counter { name, doc, kind: CounterKind::Info }
}

/// The pass.
pub static PASS: Pass = Pass {
    name: "silhouettes",
    stage: &STAGE,
    doc: "Counts the casters before one light sample, and what edges change on the way to each other one.",
    source: "Laine et al. 2005; Forest, Barthe, Paulin 2008; departs: any topology, exact, in the lists of Sintorn 2008",
    ignores: &[
        "light_frame",
        "normal",
        "list_length",
        "list_far",
        "lu",
        "lu_layout",
        "bvh_nodes",
        "bvh_order",
        "penumbra_state",
    ],
    params: &[],
    counters: &[
        info("gathered", "casters in the shafts of parts of cells, once a part"),
        info("borders", "edges where joined casters end, once a part"),
        info(
            "recounted",
            "(row, chosen light sample) pairs for which joined casters were counted one by one; row as below",
        ),
        info(
            "near",
            "(row, caster) pairs, not of joined casters, in which the caster may hide a part of the light; row as below",
        ),
        info("crossing", "(row, edge) pairs whose jump was added; row as below"),
        info(
            "whole_rows",
            "rows all of whose light samples were decided at once; a row is a view-sample, or where its own plane cuts the light its light samples of one side",
        ),
        info("counted_rows", "rows, as above, that edges crossed"),
        info("left_rows", "rows, as above, left to single tests because no light sample could be counted at"),
        info("single", "(view-sample, caster) pairs tested alone"),
        info(
            "exact",
            "light samples, of a view-sample or of a caster tested alone, that only the predicate could decide",
        ),
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
