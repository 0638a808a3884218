//! All rows in parallel.

use crate::shared::light_box::LightBox;
use crate::shared::lu::{BLOCK, Layout, MOST_CPU_BYTES, check_bytes, even};
use crate::shared::lu_fill::{Direction, Rows, fill, first_certain, first_possible, opposite_direction};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The table's words.
pub fn table(samples: &[[f32; 3]], layout: &Layout, size: usize) -> Vec<u32> {
    let rows = Rows { count: size * size, size, opposite: opposite_direction };
    let direction = |row: usize| Direction::new(row / size, row % size, size);
    fill(layout, samples, rows, direction, |direction, offset| {
        let [low, high] = direction.range(offset);
        [first_certain(low, size), first_possible(high, size)]
    })
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let samples = cx.input("light_samples").as_vec3();
    let size = even(cx.params().u32("size"));
    let shape = [samples.len().div_ceil(BLOCK), size, size, size, 8];
    check_bytes(&shape, MOST_CPU_BYTES)?;
    let layout = Layout::new(&LightBox::new(samples));
    cx.put("lu", Array::u32(shape, table(samples, &layout, size)));
    let words = layout.to_words();
    cx.put("lu_layout", Array::f32([words.len()], words));
    Ok(())
}
