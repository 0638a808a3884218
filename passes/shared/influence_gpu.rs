//! What recipes with influence regions share: the light's bound by one workgroup, and the walk over regions in memory.

use super::face_light::Bounds;
use super::light_bound::Shape;
use super::light_frame;
use super::pair_walk_gpu::{self, Kernel};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, LOOP_STEPS, PRELUDE};

const LIGHT: &[&str] = &[PRELUDE, light_frame::WGSL, include_str!("light_bound.wgsl")];
const WALK: &[&str] = &[PRELUDE, light_frame::WGSL, pair_walk_gpu::WGSL, include_str!("influence_walk.wgsl")];

/// Words of a region.
pub const REGION_WORDS: usize = 128;
/// Regions in memory at a time: 32 MiB.
pub const REGIONS_AT_A_TIME: usize = 1 << 16;

/// Words of the light's bound.
const BODY_WORDS: usize = 68;
/// Loops over all light samples that each invocation of the light's bound takes its share of.
const SAMPLE_LOOPS: usize = 8;
/// Light samples that one workgroup can go through, with as many steps again for the polygon's sides.
const MOST_LIGHT_SAMPLES: usize = LOOP_STEPS / (2 * SAMPLE_LOOPS) * GROUP;

/// Records the light's bound, from ports `light_samples` and `light_frame`: what `face_light.wgsl` reads.
///
/// # Errors
/// More light samples than one workgroup goes through.
pub fn record_body(cx: &mut GpuCx, shape: Shape, bounds: Bounds) -> Result<Target, Problem> {
    let light_count = cx.dim("light_samples", 0);
    if light_count > MOST_LIGHT_SAMPLES {
        return Err(Problem::new(Kind::Unsupported, "more light samples than one workgroup goes through")
            .port("light_samples")
            .expected(format!("at most {MOST_LIGHT_SAMPLES}"))
            .found(light_count.to_string())
            .remedy("run this node on the CPU backend"));
    }
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
    Ok(body)
}

/// The walk over `regions`.
pub fn kernel(regions: &[Target]) -> Kernel<'_> {
    Kernel {
        pieces: WALK,
        entries: ["influence", "influence_rows", "influence_shares"],
        labels: ["influence", "influence/rows", "influence/shares"],
        sources: regions,
    }
}
