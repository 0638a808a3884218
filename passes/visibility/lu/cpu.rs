//! Look-ups by two angles and a distance.

use super::FORM;
use crate::shared::lu::Bins;
use crate::shared::lu_look_up::look_up;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    look_up(cx, FORM, Bins::angles_distance)
}
