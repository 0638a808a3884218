//! The recipe of the light's box.

use shadowgraph_core::record::{Bind, GpuCx, Target, UNIFORM_WORDS};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const LIGHT_BOX: &[&str] = &[PRELUDE, include_str!("light_box.wgsl")];

/// Light samples of a block: past the last, it repeats.
pub const BLOCK: usize = 256;
/// Words of a block: a multiple of what uniforms start at; `LIGHT_BLOCK` vectors in the kernel.
const BLOCK_WORDS: usize = 13 * UNIFORM_WORDS;
/// Words of it that are read.
const READ_WORDS: usize = 4 * (2 + 3 * BLOCK / 4);

/// Records the box of the first `count` light samples, one or more, in the layout of `light_box.wgsl`.
pub fn record_light_box(cx: &mut GpuCx, count: usize) -> Target {
    let light = cx.scratch("light_box", count.div_ceil(BLOCK) * BLOCK_WORDS);
    let bind =
        vec![Bind::Uniform(vec![count as u32]), Bind::Read(Target::Port("light_samples")), Bind::ReadWrite(light)];
    cx.dispatch("light_box", LIGHT_BOX, "light_box", bind, 1, GROUP);
    light
}

/// Block `block` of a light's box, as a uniform.
pub fn block_of(light: Target, block: usize) -> Bind {
    let start = block * BLOCK_WORDS;
    Bind::UniformOf(light, start..start + READ_WORDS)
}

#[test]
fn the_kernel_states_the_same_block() {
    assert!(include_str!("light_box.wgsl").contains(&format!("const LIGHT_BLOCK: u32 = {}u;", BLOCK_WORDS / 4)));
}
