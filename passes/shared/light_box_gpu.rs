//! The recipe of the light's box.

use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const LIGHT_BOX: &[&str] = &[PRELUDE, include_str!("light_box.wgsl")];

/// Light samples of a block: past the last, it repeats.
pub const BLOCK: usize = 128;

/// Records the box of the first `count` light samples, one or more, in the layout of `light_box.wgsl`.
pub fn record_light_box(cx: &mut GpuCx, count: usize) -> Target {
    let light = cx.scratch("light_box", 4 * (2 + 3 * count.div_ceil(BLOCK) * BLOCK / 4 + count));
    let bind =
        vec![Bind::Uniform(vec![count as u32]), Bind::Read(Target::Port("light_samples")), Bind::ReadWrite(light)];
    cx.dispatch("light_box", LIGHT_BOX, "light_box", bind, 1, GROUP);
    light
}
