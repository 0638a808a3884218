//! Stage `conservative_raster`: Every non-empty light texel touched by a caster, however little, gets a pair (Sintorn 2008, section 3.2).

pub mod binning;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
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
pub const PASSES: &[&Pass] = &[&binning::PASS];
