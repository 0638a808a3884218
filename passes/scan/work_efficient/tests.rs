use super::PASS;
use crate::ports;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;

#[test]
fn the_pass_reads_the_cells_row_by_row() {
    let length = Array::u32([1, 2, 2], vec![4, 0, 1, 3]);
    let params = Params::default();
    let mut cx = CpuCx::new(&PASS, &params, [1, 1], vec![(ports::LENGTH.name, &length)], &|_, _| {});
    super::cpu::run(&mut cx).unwrap();
    let (outputs, _) = cx.finish();
    assert_eq!(outputs, [(ports::OFFSET.name, Array::u32([5], vec![0, 4, 4, 5, 8]))]);
}
