//! The running sum.

use crate::ports;
use crate::shared::scan::fits;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// Offsets of lists of these lengths, and the total.
///
/// # Errors
/// A total past 32 bits.
pub fn running_sum(lengths: &[u32]) -> Result<Vec<u32>, Problem> {
    let mut total = 0;
    let mut offsets = Vec::with_capacity(lengths.len() + 1);
    for length in lengths {
        offsets.push(total as u32);
        total += u64::from(*length);
    }
    offsets.push(fits(total)?);
    Ok(offsets)
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let offsets = running_sum(cx.input(ports::LENGTH.name).as_u32())?;
    cx.put(ports::OFFSET.name, Array::u32([offsets.len()], offsets));
    Ok(())
}
