//! Stage `sample_filter`: Which view-samples need an answer (Sintorn 2008, section 3, Figure 2).

pub mod all;
pub mod light_facing;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "sample_filter",
    doc: "Which view-samples need an answer (Sintorn 2008, section 3, Figure 2).",
    ports: &[
        ports::POSITION.read(),
        ports::NORMAL.read(),
        ports::TRIANGLE.read(),
        input::LIGHT_SAMPLES.read(),
        ports::SAMPLE_STATE,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&light_facing::PASS, &all::PASS];

/// One state a view-sample.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::SAMPLE_STATE.name, vec![cx.dim(ports::POSITION.name, 0)])]
}

/// View-samples one thread takes at a time: long enough to hide the hand-over, short enough to share out.
const CHUNK: usize = 1 << 14;
