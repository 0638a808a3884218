//! `shafts`: all segments from a group of view-samples to a group of light samples are decided at once where they can be.
//!
//! Laine, Aila 2005, hierarchical penumbra casting: one hierarchy over view-samples, one over light samples. Sintorn, Eisemann,
//! Assarsson 2008, section 4, says what is asked: a bit for each view-sample and light sample.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`, `light_samples [L 3]` world, `position [P 3]` world, `triangle [P]`,
//! `sample_state [P]`. Out: `mask [P ceil(L/32)]`; all bits set for a view-sample facing away, none for background.
//! The mask equals [`crate::shared::predicate::blocks`] bit for bit, for any L, whatever the instruction set, the threads or the parameter.
//! A light sample that is not finite is an error.
//!
//! The way of a cluster, which is a tile of 16 x 16 pixels:
//! 1. a frame that looks at the light; view-samples and light samples in blocks of sixteen, each with a tree of groups (`groups`);
//! 2. casters from a tree of boxes (`tree`) that the shaft of the whole cluster meets, without those that its view-samples' own
//!    triangles hold back (`own`);
//! 3. `divide`: sixteen casters at once are certainly beside a shaft, certainly across all of it, or stay open (`shaft`); joined casters
//!    without a border inside are decided by one segment (`patches`); what stays open goes to the halves of the wider group;
//! 4. sixteen view-samples go on alone: by ray packets, view-sample by view-sample (`rays`), or, where the first one's packets cost more than
//!    is expected of that, down to sixteen light samples, segment by segment (`leaf`).
//!
//! All of it is in f32 with bounds on rounding; what is in doubt goes to the predicate.
//!
//! Departs from the papers: no lists, no table, no influence region, and a shaft is divided on either side.
//!
//! Why so, with figures of two threads of an AVX-512 machine, in processor time of the pass:
//! - steps are written out, for a closure handed to `array::map` is compiled without the instruction set around it, and takes more than
//!   twice the time;
//! - casters are looked at view-sample by view-sample once before the leaves: near its own view-samples a group's bounds are wide, and three
//!   quarters of the pairs at the leaves would be casters that no single view-sample's cone meets. It takes a fifth off;
//! - own triangles are asked about once for the cluster, not for each group: a third less where tiles hold many of them;
//! - bounds on rounding are by lengths, not by sums of coordinates: two thirds of the exact pairs and a sixth of the time less;
//! - a plane of equal x, y or z is asked by a comparison, for floors and walls would go the exact predicate's longest way, and own planes
//!   are asked sixteen at once: a third of the apartment's time, a sixth of Sponza's;
//! - the tree and neighbours are made for this pass, not for rays: 45 ms, not 210, on the apartment;
//! - casters are sorted by what they hide, once for the cluster: half of the apartment's pairs at the leaves; the wrong order costs ten times
//!   as many;
//! - only the patch in the way of one segment is followed: to join all casters of a shaft costs four times as much, which is what it saves
//!   on all but closed fine meshes. A quarter to two fifths off the bunny, the torus knot and Sponza seen from near, nothing lost on hair;
//! - ray packets take a quarter off hair and Sponza, a third off the apartment overview. What is left is the search for the few casters in
//!   the way of each view-sample, and on coarse meshes packets lose;
//! - at the leaves, a bit for each light sample is or'd into the view-samples' lanes: a quarter of the leaves' time less than storing masks
//!   light by light and reading them back;
//! - masks are kept light by light and turned, thirty-two bits at once, when written: 5 ms for 1024 light samples, where bit by bit is 34;
//! - the lights' order is found by halving intervals and compressing registers: a third of the 40 ms that selecting among points takes for
//!   1024 light samples;
//! - sixteen casters are held against each box of light samples: with 1024 light samples, each caster against sixteen boxes at once loses a
//!   seventh on columns, as the tests segment by segment are what costs.

mod candidates;
mod cluster;
mod cpu;
mod divide;
mod groups;
mod halving;
mod leaf;
mod order;
mod own;
mod patches;
mod plane;
mod rays;
mod shaft;
mod splits;
#[cfg(test)]
mod tests;
mod tree;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// Casters, view-samples or light samples that a register holds.
const LANES: usize = 16;
/// View-samples of a cluster at most.
const MOST_VIEWS: usize = 256;

/// The first `count` of sixteen.
#[inline(always)]
fn lanes_from(count: usize) -> u16 {
    if count >= LANES { u16::MAX } else { (1 << count) - 1 }
}

const fn info(name: &'static str, doc: &'static str) -> Counter {
    Counter { name, doc, kind: CounterKind::Info }
}

/// The pass.
pub static PASS: Pass = Pass {
    name: "shafts",
    stage: &STAGE,
    doc: "Decides whole shafts between groups of view-samples and of light samples, and divides those it cannot.",
    source: "Laine, Aila 2005 (hierarchy); Sintorn 2008, section 4 (samples); departs: no lists, no table, exact",
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
    params: &[
        ParamSpec {
            name: "patches",
            range: Range::Word { words: &["auto", "always", "off"], default: "auto" },
            unit: "",
            doc: "when joined casters of one facing are decided together; auto: while it pays; never changes the mask",
        },
        ParamSpec {
            name: "leaves",
            range: Range::Word { words: &["auto", "triangles", "rays"], default: "auto" },
            unit: "",
            doc: "how sixteen view-samples are decided: caster by caster, or ray packet by ray packet; auto: by estimated cost; never changes the mask",
        },
    ],
    counters: &[
        info("shafts", "shafts looked at"),
        info("lit_shafts", "shafts found to hold no caster"),
        info("covered_shafts", "shafts found to be blocked by one caster"),
        info("patch_shafts", "shafts found to be blocked by one patch"),
        info("met", "(caster, shaft) pairs looked at"),
        info("tested", "(caster, 16 view-samples, 16 light samples) tested segment by segment"),
        info("ray_shafts", "shafts of sixteen view-samples left to ray packets"),
        info("cast", "(caster, view-sample, 16 light samples) tested segment by segment"),
        info("exact", "(segment, caster) pairs that only exact arithmetic could decide"),
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
