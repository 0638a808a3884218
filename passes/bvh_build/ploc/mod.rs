//! `ploc`: neighbouring boxes are joined from the leaves up (Meister, Bittner 2018), then improved by reinsertion and
//! collapsed, by the obvhs crate.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]` (1: casts). Out: `bvh_nodes [max(2 T - 1, 1) 8]` in the form of
//! [`crate::shared::threaded`], `bvh_order [T]`; both hold all bits set past their end.
//!
//! After it: every casting triangle whose coordinates are finite is in one leaf, inside its box and all boxes above. Triangles
//! that are not finite are left out: no predicate can be decided on them.
//!
//! CPU only: the tree travels to a device by a transfer, and graphs pin this node with `on: Cpu`.

mod cpu;
#[cfg(test)]
mod tests;

use crate::ports;
use crate::shared::threaded::NODE_WORDS;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "ploc",
    stage: &super::STAGE,
    doc: "Joins neighbouring boxes from the leaves up, by the obvhs crate.",
    source: "Meister, Bittner 2018",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: None,
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let count = cx.dim(input::TRIANGLES.name, 0);
    let nodes = (2 * count).saturating_sub(1).max(1);
    vec![(ports::BVH_NODES.name, vec![nodes, NODE_WORDS]), (ports::BVH_ORDER.name, vec![count])]
}
