//! The recipe: the light's bound and box; for a range of borders after the other their regions into memory and the walk over them, which
//! counts borders in cells and keeps no pairs; then view-samples.

use super::SUNK_ULPS;
use super::cpu::{BOUNDS, SHAPE};
use crate::ports;
use crate::shared::influence_gpu::{REGION_WORDS, REGIONS_AT_A_TIME, kernel, record_body};
use crate::shared::light_box_gpu::record_light_box;
use crate::shared::light_frame;
use crate::shared::pair_walk_gpu::{Queues, Table, record_walk};
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const BORDERS: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("../../shared/face_light.wgsl"),
    include_str!("../../shared/hull.wgsl"),
    include_str!("../../shared/influence.wgsl"),
    include_str!("../../shared/influence_store.wgsl"),
    include_str!("whole_side.wgsl"),
    include_str!("borders.wgsl"),
];
const SAMPLES: &[&str] = &[
    PRELUDE,
    include_str!("../../shared/predicate.wgsl"),
    include_str!("whole_side.wgsl"),
    include_str!("kernel.wgsl"),
];

/// Borders of a triangle: its edges and itself.
const BORDERS_EACH: usize = 4;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (triangle_count, sample_count) = (cx.dim(input::TRIANGLES.name, 0), cx.dim(ports::POSITION.name, 0));
    let [face_count, side] = [cx.dim(ports::LIST_LENGTH.name, 0), cx.dim(ports::LIST_LENGTH.name, 1)];
    let border_count = BORDERS_EACH * triangle_count;
    if face_count * border_count >= 1 << 32 {
        return Err(Problem::new(Kind::Unsupported, "more edges and faces than this recipe can number")
            .port(input::TRIANGLES.name)
            .expected("fewer than 2^32 edges and triangles on all faces")
            .found((face_count * border_count).to_string())
            .remedy("run this node on the CPU backend"));
    }
    if triangle_count == 0 || cx.dim(input::LIGHT_SAMPLES.name, 0) == 0 || sample_count == 0 {
        cx.zero(Target::Port(ports::PENUMBRA_STATE.name));
        return Ok(());
    }
    let body = record_body(cx, SHAPE, BOUNDS)?;
    let light = record_light_box(cx, cx.dim(input::LIGHT_SAMPLES.name, 0));
    let table = Table {
        caster_count: border_count,
        caster_state: cx.scratch("border_state", border_count),
        // No room: pairs are counted alone.
        pairs: ["no_cells", "no_slots", "no_casters"].map(|label| cx.scratch(label, 1)),
        caster_length: cx.scratch("borders", cx.words(ports::LIST_LENGTH.name)),
        counters: cx.scratch("walk_counters", 2),
    };
    cx.zero(table.counters);
    let range = (REGIONS_AT_A_TIME / face_count.max(1)).clamp(1, border_count);
    let regions = cx.scratch("border_regions", range * face_count * REGION_WORDS);
    let queues = Queues::new(cx, &table, range);
    for first in (0..border_count).step_by(range) {
        let count = range.min(border_count - first);
        let numbers = [triangle_count, face_count, side, first, count].map(|number| number as u32);
        let bind = vec![
            Bind::Uniform(numbers.to_vec()),
            Bind::Read(Target::Port(input::TRIANGLES.name)),
            Bind::Read(Target::Port(ports::CASTER_STATE.name)),
            Bind::Read(body),
            Bind::Read(Target::Port(ports::LIGHT_FRAME.name)),
            Bind::ReadWrite(regions),
            Bind::Read(Target::Port(ports::ACROSS.name)),
            Bind::Read(light),
            Bind::ReadWrite(table.caster_state),
            Bind::ReadWrite(Target::Counters),
        ];
        cx.dispatch("silhouettes/borders", BORDERS, "border_regions", bind, count * face_count, GROUP);
        record_walk(cx, kernel(&[regions]), &table, queues, first..first + count);
    }
    let step = SUNK_ULPS * f32::EPSILON;
    let cell_count = cx.words(ports::LIST_LENGTH.name);
    let numbers = vec![sample_count as u32, cell_count as u32, triangle_count as u32, step.to_bits(), 0];
    let on_samples = [ports::POSITION, ports::TRIANGLE, ports::SAMPLE_STATE, ports::CELL, ports::LIST_LENGTH];
    let read = [input::TRIANGLES].into_iter().chain(on_samples).map(|port| Target::Port(port.name));
    let bind = std::iter::once(Bind::Uniform(numbers))
        .chain(read.chain([table.caster_length, light]).map(Bind::Read))
        .chain([Target::Port(ports::PENUMBRA_STATE.name), Target::Counters].map(Bind::ReadWrite));
    cx.dispatch("silhouettes", SAMPLES, "silhouettes", bind.collect(), sample_count.max(cell_count), GROUP);
    Ok(())
}
