use super::cpu::build;
use crate::shared::threaded::{END, NODE_WORDS, Node};

#[test]
fn one_casting_triangle_is_a_leaf_a_step_wider_than_it() {
    let triangles = [[[0.0, 1.0, 2.0], [4.0, 1.0, 2.0], [0.0, 3.0, 2.0]], [[9.0; 3]; 3], [[f32::NAN; 3]; 3]];
    let (words, order) = build(&triangles, &[1, 0, 1]);
    assert_eq!((words.len(), order.as_slice()), (5 * NODE_WORDS, [0, END, END].as_slice()));
    let (nodes, _) = words.as_chunks::<NODE_WORDS>();
    let node = Node::of(nodes, 0);
    assert_eq!((node.triangles(), node.skip()), (Some(0..1), END));
    assert_eq!(node.low(), [0.0, 1.0, 2.0].map(f32::next_down));
    assert_eq!(node.high(), [4.0, 3.0, 2.0].map(f32::next_up));
    assert!(words[NODE_WORDS..].iter().all(|word| *word == END));
}

#[test]
fn sizes_hold_whatever_casts() {
    assert_eq!(build(&[], &[]).0.len(), NODE_WORDS);
    assert_eq!(build(&[[[1.0; 3]; 3]; 4], &[0; 4]).0.len(), 7 * NODE_WORDS);
    assert_eq!(build(&[[[1.0; 3]; 3]; 4], &[1; 4]).1.len(), 4);
}
