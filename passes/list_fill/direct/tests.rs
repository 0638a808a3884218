use super::{PASS, cpu};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;
use shadowgraph_core::shared::NO_CELL;

fn fill(cell: Vec<u32>, slot: Vec<u32>, offset: Vec<u32>) -> Array {
    let [cell, slot, offset] = [cell, slot, offset].map(|words| Array::u32([words.len()], words));
    let params = Params::default();
    let inputs = vec![("cell", &cell), ("slot", &slot), ("list_offset", &offset)];
    let mut cx = CpuCx::new(&PASS, &params, [1, 1], inputs, &|_, _| {});
    cpu::run(&mut cx).unwrap();
    cx.finish().0.remove(0).1
}

#[test]
fn four_view_samples_in_two_lists() {
    let entries = fill(vec![3, 1, NO_CELL, 3], vec![1, 0, 0, 0], vec![0, 0, 1, 1, 3]);
    assert_eq!(entries.as_u32(), [1, 3, 0, 0]);
}

#[test]
fn every_listed_view_sample_stands_there_once() {
    for count in [0u32, 1, 63, 64, 65, 257, 100_000] {
        // Every third view-sample is in no list; the others take turns in 50 cells.
        let cell_of = |i: u32| if i.is_multiple_of(3) { NO_CELL } else { i % 50 };
        let cell: Vec<u32> = (0..count).map(cell_of).collect();
        let mut length = [0; 50];
        let place = |cell: &u32| {
            let Some(length) = length.get_mut(*cell as usize) else { return 0 };
            *length += 1;
            *length - 1
        };
        let slot: Vec<u32> = cell.iter().map(place).collect();
        let offset: Vec<u32> = (0..=50).map(|cell| length[..cell].iter().sum()).collect();
        let total = offset[50] as usize;
        let mut entries = fill(cell, slot, offset).as_u32()[..total].to_vec();
        entries.sort_unstable();
        let listed: Vec<u32> = (0..count).filter(|i| !i.is_multiple_of(3)).collect();
        assert!(entries == listed, "{count}");
    }
}
