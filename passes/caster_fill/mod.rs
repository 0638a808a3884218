//! Stage `caster_fill`: Writes each pair's caster to its place in the caster table.

pub mod direct;

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "caster_fill",
    doc: "Writes each pair's caster to its place in the caster table.",
    ports: &[
        ports::PAIR_CELL.read(),
        ports::PAIR_SLOT.read(),
        ports::PAIR_CASTER.read(),
        ports::OFFSET.read().named(CASTER_OFFSET),
        ports::CASTER_ENTRIES,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&direct::PASS];

/// The input port with the start of each cell's casters.
const CASTER_OFFSET: &str = "caster_offset";

/// One entry a pair.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::CASTER_ENTRIES.name, vec![cx.dim(ports::PAIR_CELL.name, 0)])]
}
