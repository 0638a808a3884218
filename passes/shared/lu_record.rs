//! The recipe that passes of stage `lu_table` share.

use super::lu::{BLOCK, check_bytes};
use shadowgraph_core::light_plane::{ROUNDING, SHARE};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};
use std::f64::consts::PI;

const LAYOUT: &[&str] = &[PRELUDE, include_str!("lu_layout.wgsl")];

/// Vectors of `turns` in the kernel.
const TURNS: usize = 1024;

/// Records the layout, and the table by `lu_fill` of `pieces`.
///
/// # Errors
/// A table larger than the device binds.
pub fn record_lu(cx: &mut GpuCx, pieces: &'static [&'static str], is_planar: bool) -> Result<(), Problem> {
    let shape = [0, 1, 2, 3, 4].map(|axis| cx.dim("lu", axis));
    check_bytes(&shape, cx.limits().storage_binding_bytes)?;
    let light_sample_count = cx.dim("light_samples", 0);
    let size = shape[1];
    // A pass without counters has no memory for them.
    let off_plane = if is_planar { Target::Counters } else { cx.scratch("off_plane", 1) };
    let layout = vec![
        Bind::Uniform(vec![light_sample_count as u32, u32::from(is_planar), SHARE.to_bits(), ROUNDING.to_bits()]),
        Bind::Read(Target::Port("light_samples")),
        Bind::ReadWrite(Target::Port("lu_layout")),
        Bind::ReadWrite(off_plane),
    ];
    cx.dispatch("lu_layout", LAYOUT, "lu_layout_of", layout, 1, GROUP);
    let rows = if is_planar { size } else { size * size };
    let blocks = light_sample_count.div_ceil(BLOCK);
    if blocks == 0 {
        return Ok(());
    }
    let mut numbers: Vec<u32> = [light_sample_count, size, rows, blocks].map(|number| number as u32).to_vec();
    let mut turn = |angle: f64| {
        numbers.extend([angle.sin() as f32, angle.cos() as f32].map(f32::to_bits));
    };
    turn(0.5 * PI / size as f64);
    turn(PI / size as f64);
    for bin in 0..TURNS {
        turn(PI * (bin as f64 + 0.5) / size as f64);
        turn(PI * ((2 * bin + 1) as f64 / size as f64 - 1.0));
    }
    let fill = vec![
        Bind::Uniform(numbers),
        Bind::Read(Target::Port("light_samples")),
        Bind::Read(Target::Port("lu_layout")),
        Bind::ReadWrite(Target::Port("lu")),
    ];
    cx.dispatch("lu_fill", pieces, "lu_fill", fill, rows * blocks, GROUP);
    Ok(())
}
