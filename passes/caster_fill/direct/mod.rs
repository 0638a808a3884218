//! Pass `caster_fill/direct`: every pair writes its caster to its place in the caster table. The paper has no such table,
//! since its rasteriser meets a texel's list while it draws; a table lets every view-sample walk its casters in one go,
//! with the layout of Sintorn 2008, section 3.1.
//!
//! In: `pair_cell [E] u32`, `pair_slot [E] u32`, `pair_caster [E] u32`, `caster_offset [C+1] u32`, whose last entry is the
//! number of pairs. Out: `caster_entries [E] u32`,
//! `caster_entries[caster_offset[pair_cell[i]] + pair_slot[i]] = pair_caster[i]`; past the total zero on the CPU and
//! undefined on a GPU.
//!
//! Pairs past the total are undefined and not read. Where there were more pairs than E, which the raster pass reports,
//! nothing is written past the end.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use shadowgraph_core::pass::{Contract, Pass};

/// One write a pair.
pub static PASS: Pass = Pass {
    name: "direct",
    stage: &super::STAGE,
    doc: "Each pair writes its caster to its place.",
    source: "Sintorn 2008, section 3.1",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Sets,
    features: &[],
    size: super::size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};
