//! The recipe: the light's bound by one workgroup; then, for a range of casters after the other, their regions into memory and the
//! walk over them.

use super::cpu::bounds;
use crate::shared::light_bound::Shape;
use crate::shared::light_frame;
use crate::shared::pair_walk_gpu::{self, Kernel, Queues, record_walk};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, LOOP_STEPS, PRELUDE};

const LIGHT: &[&str] = &[PRELUDE, light_frame::WGSL, include_str!("../../shared/light_bound.wgsl")];
const REGIONS: &[&str] = &[
    PRELUDE,
    light_frame::WGSL,
    include_str!("../../shared/face_light.wgsl"),
    include_str!("../../shared/hull.wgsl"),
    include_str!("../../shared/influence.wgsl"),
    include_str!("regions.wgsl"),
];
const WALK: &[&str] = &[PRELUDE, light_frame::WGSL, pair_walk_gpu::WGSL, include_str!("kernel.wgsl")];

/// Words of a region.
const REGION_WORDS: usize = 128;
/// Regions in memory at a time: 32 MiB.
const REGIONS_AT_A_TIME: usize = 1 << 16;

/// Words of the light's bound.
const BODY_WORDS: usize = 68;
/// Loops over all light samples that each invocation of the light's bound takes its share of.
const SAMPLE_LOOPS: usize = 8;
/// Light samples that one workgroup can go through, with as many steps again for the polygon's sides.
const MOST_LIGHT_SAMPLES: usize = LOOP_STEPS / (2 * SAMPLE_LOOPS) * GROUP;

/// Records the pass.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let light_count = cx.dim("light_samples", 0);
    if light_count > MOST_LIGHT_SAMPLES {
        return Err(Problem::new(Kind::Unsupported, "more light samples than one workgroup goes through")
            .port("light_samples")
            .expected(format!("at most {MOST_LIGHT_SAMPLES}"))
            .found(light_count.to_string())
            .remedy("run this node on the CPU backend"));
    }
    if cx.dim("triangles", 0) == 0 {
        cx.zero(Target::Port("caster_length"));
        return Ok(());
    }
    let (shape, bounds) = bounds(cx.params());
    let body = cx.scratch("light_body", BODY_WORDS);
    let step = std::f64::consts::TAU / bounds.sides as f64;
    let widened = (1.0 / (0.5 * step).cos() * 1.000_001) as f32;
    let mut words =
        vec![light_count as u32, bounds.sides as u32, u32::from(shape == Shape::Ellipsoid), widened.to_bits()];
    for k in 0..8 {
        let (sin, cos) = (step * f64::from(k)).sin_cos();
        words.extend([cos, sin].map(|x| (x as f32).to_bits()));
    }
    let bind = vec![
        Bind::Uniform(words),
        Bind::Read(Target::Port("light_samples")),
        Bind::Read(Target::Port("light_frame")),
        Bind::ReadWrite(body),
    ];
    cx.dispatch("influence/light", LIGHT, "influence_light", bind, 1, GROUP);
    let triangle_count = cx.dim("triangles", 0);
    let [face_count, side] = [cx.dim("list_length", 0), cx.dim("list_length", 1)];
    let range = (REGIONS_AT_A_TIME / face_count.max(1)).clamp(1, triangle_count.max(1));
    let regions = cx.scratch("influence_regions", range * face_count * REGION_WORDS);
    let kernel = Kernel {
        pieces: WALK,
        entries: ["influence", "influence_rows", "influence_shares"],
        labels: ["influence", "influence/rows", "influence/shares"],
        sources: &[regions],
    };
    let queues = Queues::new(cx, range);
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
        record_walk(cx, kernel, queues, first..first + count);
    }
    Ok(())
}
