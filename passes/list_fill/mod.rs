//! Stage `list_fill`: Writes each view-sample to its place in the one packed array (Sintorn 2008, section 3.1).

pub mod direct;

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "list_fill",
    doc: "Writes each view-sample to its place in the one packed array (Sintorn 2008, section 3.1).",
    ports: &[ports::CELL.read(), ports::SLOT.read(), ports::OFFSET.read().named(LIST_OFFSET), ports::LIST_ENTRIES],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&direct::PASS];

/// The input port with the start of each list.
const LIST_OFFSET: &str = "list_offset";

/// One entry a view-sample: no more can be listed.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::LIST_ENTRIES.name, vec![cx.dim(ports::CELL.name, 0)])]
}
