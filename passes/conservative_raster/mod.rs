//! Stage `conservative_raster`: Every non-empty light texel touched by a caster, however little, gets a pair (Sintorn 2008, section 3.2).

pub mod binning;
pub mod device;
pub mod expanded_draw;
pub mod influence;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Counter, CounterKind, Pass};
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "conservative_raster",
    doc: "Every non-empty light texel touched by a caster, however little, gets a pair (Sintorn 2008, section 3.2).",
    ports: &[
        input::TRIANGLES.read(),
        ports::CASTER_STATE.read(),
        input::LIGHT_SAMPLES.read(),
        ports::LIGHT_FRAME.read(),
        ports::LIST_LENGTH.read(),
        ports::LIST_FAR.read(),
        ports::PAIR_CELL,
        ports::PAIR_SLOT,
        ports::PAIR_CASTER,
        ports::CASTER_LENGTH,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&binning::PASS, &influence::PASS, &expanded_draw::PASS, &device::PASS];

/// First counter of every pass of this stage.
const PAIRS: Counter = Counter { name: "pairs", doc: "(cell, caster) pairs", kind: CounterKind::Rows("pair_cell") };

/// Pairs that are made room for at first, at most: what fits the storage bindings of most devices.
const MOST_FIRST_PAIRS: usize = 1 << 25;

/// Pairs that fit where nothing is known yet, for kernels that cannot grow their outputs: a few cells a small caster, and
/// four layers of casters over every cell. The CPU functions allocate what they need.
fn pairs_size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let cells: Vec<usize> = (0..3).map(|axis| cx.dim("list_length", axis)).collect();
    let first = 8 * cx.dim("triangles", 0) + 4 * cells.iter().product::<usize>();
    let pairs = vec![cx.capacity("pair_cell", first.min(MOST_FIRST_PAIRS))];
    vec![("pair_cell", pairs.clone()), ("pair_slot", pairs.clone()), ("pair_caster", pairs), ("caster_length", cells)]
}
