use super::{PASS, cpu};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;

fn fill(pairs: &[[u32; 3]], offset: &[u32]) -> Vec<u32> {
    let [cell, slot, caster] =
        [0, 1, 2].map(|k| Array::u32([pairs.len()], pairs.iter().map(|pair| pair[k]).collect::<Vec<u32>>()));
    let offset = Array::u32([offset.len()], offset.to_vec());
    let params = Params::default();
    let inputs = vec![("pair_cell", &cell), ("pair_slot", &slot), ("pair_caster", &caster), ("caster_offset", &offset)];
    let mut cx = CpuCx::new(&PASS, &params, [1, 1], inputs, &|_, _| {});
    cpu::run(&mut cx).unwrap();
    cx.finish().0[0].1.as_u32().to_vec()
}

#[test]
fn three_pairs_and_room_for_two_more() {
    // Rows past the total must not be read: they would overwrite the others.
    let pairs = [[1, 1, 70], [0, 0, 80], [1, 0, 90], [0, 0, 11], [1, 1, 12]];
    assert_eq!(fill(&pairs, &[0, 1, 3]), [80, 90, 70, 0, 0]);
}

#[test]
fn more_pairs_than_room_stay_inside() {
    assert_eq!(fill(&[[0, 0, 5], [1, 0, 6]], &[0, 1, 4]), [5, 6]);
    assert_eq!(fill(&[[1, 1, 5]], &[0, 1, 4]), [0]);
    assert_eq!(fill(&[], &[0, 0]), [0u32; 0]);
}
