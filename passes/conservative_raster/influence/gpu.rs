//! The recipe: the light's bound by one workgroup; then, for a range of casters after the other, their regions into memory and the
//! walk over them.

use super::cpu::bounds;
use crate::shared::influence_gpu::{REGION_WORDS, REGIONS_AT_A_TIME, kernel, record_body};
use crate::shared::light_frame;
use crate::shared::pair_walk_gpu::{Queues, Table, record_walk};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const REGIONS: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("../../shared/face_light.wgsl"),
    include_str!("../../shared/hull.wgsl"),
    include_str!("../../shared/influence.wgsl"),
    include_str!("../../shared/influence_store.wgsl"),
    include_str!("regions.wgsl"),
];

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    if cx.dim("triangles", 0) == 0 {
        cx.zero(Target::Port("caster_length"));
        return Ok(());
    }
    let (shape, bounds) = bounds(cx.params());
    let body = record_body(cx, shape, bounds)?;
    let triangle_count = cx.dim("triangles", 0);
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)];
    let range = (REGIONS_AT_A_TIME / face_count.max(1)).clamp(1, triangle_count.max(1));
    let regions = cx.scratch("influence_regions", range * face_count * REGION_WORDS);
    let table = Table::pairs(cx);
    let queues = Queues::new(cx, &table, range);
    let choice = u32::from(bounds.is_quad) | u32::from(bounds.cut) << 1;
    for first in (0..triangle_count).step_by(range) {
        let count = range.min(triangle_count - first);
        let numbers = [triangle_count, face_count, side].map(|number| number as u32);
        let numbers = [numbers, [choice, first as u32, count as u32]].concat();
        let bind = vec![
            Bind::Uniform(numbers),
            Bind::Read(Target::Port("triangles")),
            Bind::Read(Target::Port("caster_state")),
            Bind::Read(body),
            Bind::Read(Target::Port("light_frame")),
            Bind::ReadWrite(regions),
        ];
        cx.dispatch("influence/regions", REGIONS, "influence_regions", bind, count * face_count, GROUP);
        record_walk(cx, kernel(&[regions]), &table, queues, first..first + count);
    }
    Ok(())
}
