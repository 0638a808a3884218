//! Stage `lu_table`: From a plane to the light samples behind it, tabulated (Sintorn 2008, section 4.2).
//!
//! Every pass gives `lu [K A B U Q]`: K blocks of 128 light samples, bins along up to three coordinates of a plane, and Q words a bin; and
//! `lu_layout`, the few numbers that say which plane falls in which bin ([`crate::shared::lu::Layout`]). The shape tells readers
//! which pass made it.

pub mod angles_distance;
pub mod certain_uncertain;
pub mod planar;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "lu_table",
    doc: "From a plane to the light samples behind it, tabulated (Sintorn 2008, section 4.2).",
    ports: &[input::LIGHT_SAMPLES.read(), ports::LU, ports::LU_LAYOUT],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&angles_distance::PASS, &certain_uncertain::PASS, &planar::PASS];
