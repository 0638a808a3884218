//! Stage `bvh_build`: A tree of boxes over the casters, for passes that trace rays (Rubin, Whitted 1980).

pub mod ploc;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "bvh_build",
    doc: "A tree of boxes over the casters, for passes that trace rays (Rubin, Whitted 1980).",
    ports: &[input::TRIANGLES.read(), ports::CASTER_STATE.read(), ports::BVH_NODES, ports::BVH_ORDER],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&ploc::PASS];
