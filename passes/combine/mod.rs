//! Stage `combine`: Mask to visible fraction (Sintorn 2008, sections 3 and 4.2).
//!
//! `visible` is what every graph has. `visible_color` is for lights of several colours: a pass that cannot tell channels apart gives
//! it no rows, and shading then takes `visible` for all three.

mod blocked;
pub mod popcount;
pub mod threshold;
pub mod weighted;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "combine",
    doc: "Mask to visible fraction (Sintorn 2008, sections 3 and 4.2).",
    ports: &[
        ports::MASK.read(),
        ports::SAMPLE_STATE.read(),
        input::LIGHT_SAMPLES.read(),
        input::LIGHT_WEIGHTS.read(),
        ports::VISIBLE,
        ports::VISIBLE_COLOR,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&popcount::PASS, &threshold::PASS, &weighted::PASS];

/// One fraction a view-sample, no colour.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::VISIBLE.name, vec![cx.dim(ports::SAMPLE_STATE.name, 0)]), (ports::VISIBLE_COLOR.name, vec![0, 3])]
}
