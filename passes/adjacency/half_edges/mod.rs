//! `half_edges`: half edges of casting triangles, joined where exactly two meet and run against each other.
//!
//! In: `triangles [T 3 3]` world, `caster_state [T]`. Out: `across [T 3]`: at edge k, from corner k to the next, the casting triangle
//! across; all bits set where there is none or more than one, where it is wound the other way, and for all edges of a triangle that
//! does not cast.
//!
//! After it: `across[across[t][k]]` holds t at the same edge. Corners are the same when their coordinates are equal: cracks and
//! T-junctions are open edges. A collapsed triangle may lie across itself.
//!
//! CPU only: what lies across travels to a device by a transfer, and graphs pin this node with `on: Cpu`. It depends on neither camera
//! nor light, but for which triangles cast.

mod cpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;

/// The pass.
pub static PASS: Pass = Pass {
    name: "half_edges",
    stage: &super::STAGE,
    doc: "Joins the half edges of casting triangles where exactly two meet and run against each other.",
    source: "Sintorn 2008, section 4.3, after Laine et al. 2005",
    ignores: &[],
    params: &[],
    counters: &[Counter {
        name: "open_edges",
        doc: "edges of casting triangles with nothing across, each as often as a triangle has it",
        kind: CounterKind::Info,
    }],
    contract: Contract::Exact,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: None,
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::ACROSS.name, vec![cx.dim(input::TRIANGLES.name, 0), 3])]
}
