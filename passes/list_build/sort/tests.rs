use super::cpu::{by_cell, sort};
use super::gpu::DIGIT_BITS;
use crate::list_build::place::Samples;
use crate::list_build::tests::face;
use shadowgraph_core::shared::{KEPT, NO_CELL};

#[test]
fn pairs_are_in_order_of_cell_then_view() {
    let pair = |cell: u64, view_sample: u64| cell << 32 | view_sample;
    assert_eq!(by_cell(&[5, 2, NO_CELL, 5, 2], 6), [pair(2, 1), pair(2, 4), pair(5, 0), pair(5, 3)]);
    assert_eq!(by_cell(&[], 6), [0u64; 0]);
}

#[test]
fn every_number_of_digits_sorts() {
    for cell_count in [1u32, 2, 2048, 2049, 1 << 20, 1 << 23, 96 << 20] {
        let cells: Vec<u32> = (0..50_000u32).map(|i| i.wrapping_mul(2_654_435_761) % cell_count).collect();
        let sorted = by_cell(&cells, cell_count as usize);
        assert_eq!(sorted.len(), cells.len());
        assert!(sorted.windows(2).all(|two| two[0] < two[1]), "{cell_count}");
        assert!(sorted.iter().all(|pair| cells[*pair as u32 as usize] == (pair >> 32) as u32));
    }
}

#[test]
fn slots_are_ranks_in_view_order() {
    let positions: Vec<[f32; 3]> = (0..70_000).map(|i| [(i % 7) as f32 * 0.2 - 0.6, 0.0, 0.0]).collect();
    let states = vec![KEPT; positions.len()];
    let lists = sort(&Samples { positions: &positions, states: &states, faces: vec![face()], side: 64 });
    for (index, slot) in lists.slot.iter().enumerate() {
        assert_eq!(*slot as usize, index / 7);
    }
}

#[test]
fn the_constants_of_the_kernel_are_those_of_the_recipe() {
    assert!(include_str!("digit.wgsl").contains(&format!("const DIGIT_BITS: u32 = {DIGIT_BITS}u;")));
}
