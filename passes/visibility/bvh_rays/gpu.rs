//! One dispatch starts the masks, then one for each word of them.

use crate::ports;
use crate::shared::threaded;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::record::Target::{Counters, Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const PIECES: &[&str] =
    &[PRELUDE, include_str!("../../shared/predicate.wgsl"), threaded::WGSL, include_str!("kernel.wgsl")];

/// Nodes and triangles that one ray may visit: with the steps of the own plane's rule well below what a software rasteriser
/// runs before it cuts loops in silence.
pub const RAY_STEPS: u32 = 24_000;

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    if !(cx.is_connected(ports::BVH_NODES.name) && cx.is_connected(ports::BVH_ORDER.name)) {
        return Err(Problem::new(Kind::Missing, "rays on wgpu walk a tree that another node has built")
            .port(ports::BVH_NODES.name)
            .expected("a node of stage bvh_build in the graph, pinned with `on: Cpu`")
            .remedy("use the graph `rays`, add such a node, or set `on: Cpu` for this one"));
    }
    let (rows, light_count) = (cx.dim(ports::POSITION.name, 0), cx.dim(input::LIGHT_SAMPLES.name, 0));
    let row_words = cx.dim(ports::MASK.name, 1);
    let bind = |word: usize| {
        let counts = [rows, light_count, row_words, word].map(|count| count as u32);
        vec![
            Uniform([counts.as_slice(), &[RAY_STEPS, 0]].concat()),
            Read(Port(input::TRIANGLES.name)),
            Read(Port(input::LIGHT_SAMPLES.name)),
            Read(Port(ports::POSITION.name)),
            Read(Port(ports::TRIANGLE.name)),
            Read(Port(ports::SAMPLE_STATE.name)),
            Read(Port(ports::BVH_NODES.name)),
            Read(Port(ports::BVH_ORDER.name)),
            ReadWrite(Port(ports::MASK.name)),
            ReadWrite(Counters),
        ]
    };
    cx.dispatch("bvh_rays start", PIECES, "bvh_rays_start", bind(0), rows * row_words, GROUP);
    for word in 0..row_words {
        cx.dispatch("bvh_rays", PIECES, "bvh_rays", bind(word), 32 * rows, GROUP);
    }
    Ok(())
}
