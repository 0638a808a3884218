//! `shafts`: all segments from a group of view-samples to a group of light samples are decided at once where they can be.
//!
//! Laine, Aila 2005, hierarchical penumbra casting: a hierarchy over view-samples and one over light samples.

mod candidates;
mod cluster;
mod cpu;
mod groups;
mod leaf;
mod own;
mod shaft;
#[cfg(test)]
mod tests;
mod tree;

use super::STAGE;
use crate::ports;
use crate::shared::segments::mask_words;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// Casters, view-samples or light samples that a register holds.
const LANES: usize = 16;

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
    ],
    params: &[],
    counters: &[
        info("shafts", "shafts looked at"),
        info("lit_shafts", "shafts found to hold no caster"),
        info("covered_shafts", "shafts found to be blocked by one caster"),
        info("met", "(caster, shaft) pairs looked at"),
        info("tested", "(caster, 16 view-samples, 16 light samples) tested segment by segment"),
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
