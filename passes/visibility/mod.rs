//! Stage `visibility`: Which light samples each view-sample cannot see (Sintorn 2008, sections 3.3 and 4.2).

pub mod bvh_rays;
pub mod exact;
pub mod fused;
pub mod fused_draw;
pub mod half_planes;
pub mod lu;
pub mod lu_certain;
pub mod lu_planar;
pub mod multi_shadow_map;
pub mod planes;
pub mod shafts;
pub mod silhouettes;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "visibility",
    doc: "Which light samples each view-sample cannot see (Sintorn 2008, sections 3.3 and 4.2).",
    ports: &[
        input::TRIANGLES.read(),
        ports::CASTER_STATE.read(),
        input::LIGHT_SAMPLES.read(),
        ports::LIGHT_FRAME.read(),
        ports::POSITION.read(),
        ports::NORMAL.read(),
        ports::TRIANGLE.read(),
        ports::SAMPLE_STATE.read(),
        ports::CELL.read(),
        ports::LIST_LENGTH.read(),
        ports::LIST_FAR.read(),
        ports::OFFSET.read().named("list_offset"),
        ports::LIST_ENTRIES.read(),
        ports::OFFSET.read().named("caster_offset"),
        ports::CASTER_ENTRIES.read(),
        ports::LU.optional(),
        ports::LU_LAYOUT.optional(),
        ports::BVH_NODES.optional(),
        ports::BVH_ORDER.optional(),
        ports::PENUMBRA_STATE.optional(),
        ports::MASK,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[
    &planes::PASS,
    &fused::PASS,
    &fused_draw::PASS,
    &exact::PASS,
    &bvh_rays::PASS,
    &half_planes::PASS,
    &shafts::PASS,
    &silhouettes::PASS,
    &lu::PASS,
    &lu_planar::PASS,
    &lu_certain::PASS,
    &multi_shadow_map::PASS,
];
