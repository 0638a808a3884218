//! The tree, padded to the size that is known before.

use crate::ports;
use crate::shared::bvh::Bvh;
use crate::shared::threaded::NODE_WORDS;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;

/// Words of the nodes and the order of triangles.
pub fn build(triangles: &[[[f32; 3]; 3]], caster_state: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let bvh = Bvh::build(triangles, |id| caster_state[id] == 1);
    let (mut nodes, mut order) = (bvh.threaded(), bvh.order().to_vec());
    nodes.resize((2 * triangles.len()).saturating_sub(1).max(1), [u32::MAX; NODE_WORDS]);
    order.resize(triangles.len(), u32::MAX);
    (nodes.into_flattened(), order)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let triangles = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let (nodes, order) = build(triangles, cx.input(ports::CASTER_STATE.name).as_u32());
    cx.put(ports::BVH_NODES.name, Array::u32([nodes.len() / NODE_WORDS, NODE_WORDS], nodes));
    cx.put(ports::BVH_ORDER.name, Array::u32([order.len()], order));
    Ok(())
}
