//! Stage `caster_fill`: Writes each pair's caster to its place in the caster table.

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "caster_fill",
    doc: "Writes each pair's caster to its place in the caster table.",
    ports: &[
        ports::PAIR_CELL.read(),
        ports::PAIR_SLOT.read(),
        ports::PAIR_CASTER.read(),
        ports::OFFSET.read().named("caster_offset"),
        ports::CASTER_ENTRIES,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[];
