use super::*;
use crate::shared::bvh::Bvh;

fn random(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
}

fn soup(count: usize) -> Vec<[[f32; 3]; 3]> {
    let seed = &mut 3;
    (0..count)
        .map(|_| {
            let centre = [0; 3].map(|_| random(seed));
            [0; 3].map(|_| [0, 1, 2].map(|k| centre[k] + 0.1 * random(seed)))
        })
        .collect()
}

#[test]
fn every_caster_is_in_one_leaf_within_its_box_and_all_boxes_above() {
    for count in [1, 2, 7, 500] {
        let triangles = soup(count);
        let bvh = Bvh::build(&triangles, |id| id % 5 != 3);
        let (nodes, order) = (bvh.threaded(), bvh.order());
        let mut seen = vec![0; count];
        // Ends of the open subtrees, with their boxes.
        let mut open: Vec<(u32, [f32; 3], [f32; 3])> = Vec::new();
        for index in 0..nodes.len() as u32 {
            let node = Node::of(&nodes, index);
            open.retain(|(end, ..)| *end > index);
            assert!(node.skip() > index && (node.skip() == END || (node.skip() as usize) < nodes.len()));
            for (end, low, high) in &open {
                assert!(node.skip() <= *end);
                assert!((0..3).all(|k| low[k] <= node.low()[k] && node.high()[k] <= high[k]));
            }
            match node.triangles() {
                None => open.push((node.skip(), node.low(), node.high())),
                Some(places) => {
                    assert!((1..8).contains(&places.len()));
                    for id in order[places].iter().map(|id| *id as usize) {
                        seen[id] += 1;
                        let inside = |p: &[f32; 3]| (0..3).all(|k| node.low()[k] < p[k] && p[k] < node.high()[k]);
                        assert!(triangles[id].iter().all(inside));
                    }
                }
            }
        }
        assert!(seen.iter().enumerate().all(|(id, times)| *times == i32::from(id % 5 != 3)), "{seen:?}");
    }
}

#[test]
fn the_right_child_is_where_the_left_ones_subtree_ends() {
    let bvh = Bvh::build(&soup(300), |_| true);
    let nodes = bvh.threaded();
    for index in 0..nodes.len() as u32 {
        let node = Node::of(&nodes, index);
        if node.triangles().is_none() {
            let left = Node::of(&nodes, index + 1);
            let right = Node::of(&nodes, left.skip());
            assert_eq!(right.skip(), node.skip());
            let (a, b) = ((left.low(), left.high()), (right.low(), right.high()));
            assert!((0..3).all(|k| node.low()[k] == a.0[k].min(b.0[k]) && node.high()[k] == a.1[k].max(b.1[k])));
        }
    }
}

/// As the kernel's `segment_enters`.
fn segment_enters(node: &Node, start: [f32; 3], along: [f32; 3]) -> bool {
    let (mut near, mut far) = (f32::NEG_INFINITY, f32::INFINITY);
    for k in 0..3 {
        let inverse = 1.0 / if along[k].abs() < 1e-37 { 1e-37 } else { along[k] };
        let (a, b) = ((node.low()[k] - start[k]) * inverse, (node.high()[k] - start[k]) * inverse);
        (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
    }
    let early = near * if near >= 0.0 { 1.0 - SLAB_ERROR } else { 1.0 + SLAB_ERROR };
    let late = far * if far >= 0.0 { 1.0 + SLAB_ERROR } else { 1.0 - SLAB_ERROR };
    early <= late && late >= 0.0 && early <= 1.0
}

#[test]
fn a_tree_of_nothing_is_one_box_that_no_segment_meets() {
    let nodes = Bvh::build(&[], |_| true).threaded();
    assert_eq!(nodes.len(), 1);
    let node = Node::of(&nodes, 0);
    assert!(node.skip() == END && node.triangles().is_none());
    let seed = &mut 5;
    for round in 0..10_000 {
        let scale = [1.0, 1e-30, 1e6, 1e30, 0.0][round % 5];
        let [start, along] = [0; 2].map(|_| [0; 3].map(|_| scale * random(seed)));
        assert!(!segment_enters(&node, start, along), "{start:?} {along:?}");
    }
    // The walk of this test does meet boxes.
    let nodes = Bvh::build(&[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]], |_| true).threaded();
    assert!(segment_enters(&Node::of(&nodes, 0), [0.2, 0.2, -1.0], [0.0, 0.0, 2.0]));
}

#[test]
fn the_kernel_states_the_same_numbers() {
    assert!(WGSL.contains(&format!("const BVH_END: u32 = {END:#x}u;")));
    assert!(WGSL.contains(&format!("const LEAF_BITS: u32 = {LEAF_BITS}u;")));
    assert!(WGSL.contains(&format!("const SLAB_ERROR: f32 = {SLAB_ERROR:e};")));
}
