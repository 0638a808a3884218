//! The recipe: the light's bound and box; for a range of borders after the other their regions into memory and the walk over them, which
//! counts borders in cells and keeps no pairs; then view-samples.

use super::SUNK_ULPS;
use super::cpu::{BOUNDS, SHAPE};
use crate::shared::influence_gpu::{REGION_WORDS, REGIONS_AT_A_TIME, kernel, record_body};
use crate::shared::light_box_gpu::record_light_box;
use crate::shared::light_frame;
use crate::shared::pair_walk_gpu::{Queues, Table, record_walk};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const BORDERS: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("../../shared/face_light.wgsl"),
    include_str!("../../shared/hull.wgsl"),
    include_str!("../../shared/influence.wgsl"),
    include_str!("whole_side.wgsl"),
    include_str!("borders.wgsl"),
];
const SAMPLES: &[&str] = &[PRELUDE, include_str!("whole_side.wgsl"), include_str!("kernel.wgsl")];

/// Borders of a triangle: its edges and itself.
const BORDERS_EACH: usize = 4;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let (triangle_count, sample_count) = (cx.dim("triangles", 0), cx.dim("position", 0));
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)];
    let border_count = BORDERS_EACH * triangle_count;
    if face_count * border_count >= 1 << 32 {
        return Err(Problem::new(Kind::Unsupported, "more edges and faces than this recipe can number")
            .port("triangles")
            .expected("fewer than 2^32 edges and triangles on all faces")
            .found((face_count * border_count).to_string())
            .remedy("run this node on the CPU backend"));
    }
    if triangle_count == 0 || cx.dim("light_samples", 0) == 0 || sample_count == 0 {
        cx.zero(Target::Port("penumbra_state"));
        return Ok(());
    }
    let body = record_body(cx, SHAPE, BOUNDS)?;
    let light = record_light_box(cx, cx.dim("light_samples", 0));
    let table = Table {
        caster_count: border_count,
        caster_state: cx.scratch("border_state", border_count),
        // No room: pairs are counted alone.
        pairs: ["no_cells", "no_slots", "no_casters"].map(|label| cx.scratch(label, 1)),
        caster_length: cx.scratch("borders", cx.words("list_length")),
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
            Bind::Read(Target::Port("triangles")),
            Bind::Read(Target::Port("caster_state")),
            Bind::Read(body),
            Bind::Read(Target::Port("light_frame")),
            Bind::ReadWrite(regions),
            Bind::Read(Target::Port("across")),
            Bind::Read(light),
            Bind::ReadWrite(table.caster_state),
            Bind::ReadWrite(Target::Counters),
        ];
        cx.dispatch("silhouettes/borders", BORDERS, "border_regions", bind, count * face_count, GROUP);
        record_walk(cx, kernel(&[regions]), &table, queues, first..first + count);
    }
    let step = SUNK_ULPS * f32::EPSILON;
    let cell_count = cx.words("list_length");
    let numbers = vec![sample_count as u32, cell_count as u32, triangle_count as u32, step.to_bits()];
    let ports = ["triangles", "position", "triangle", "sample_state", "cell", "list_length"].map(Target::Port);
    let bind = std::iter::once(Bind::Uniform(numbers))
        .chain(ports.into_iter().chain([table.caster_length, light]).map(Bind::Read))
        .chain([Target::Port("penumbra_state"), Target::Counters].map(Bind::ReadWrite));
    cx.dispatch("silhouettes", SAMPLES, "silhouettes", bind.collect(), sample_count.max(cell_count), GROUP);
    Ok(())
}
