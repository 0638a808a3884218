use super::cpu::keep_all;
use shadowgraph_core::shared::NO_TRIANGLE;

#[test]
fn background_and_positions_that_are_not_finite_are_dropped() {
    let positions = [[0.0; 3], [1.0, 2.0, 3.0], [f32::NAN, 0.0, 0.0], [0.0, 0.0, f32::NEG_INFINITY], [0.0; 3]];
    assert_eq!(keep_all(&positions, &[0, 7, 1, 1, NO_TRIANGLE]), [1, 1, 0, 0, 0]);
    assert_eq!(keep_all(&[], &[]), [0u32; 0]);
}

#[test]
fn every_chunk_is_visited() {
    let count = 3 * crate::sample_filter::CHUNK + 5;
    assert!(keep_all(&vec![[1.0; 3]; count], &vec![0; count]).iter().all(|state| *state == 1));
}
