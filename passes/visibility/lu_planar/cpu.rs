//! Look-ups by lines in the light's plane.

use super::FORM;
use crate::shared::lu::{Bins, Layout, line_bin};
use crate::shared::lu_look_up::look_up;
use crate::shared::view_planes::Planes;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The bins of the lines in which planes meet the light's.
#[inline(always)]
fn lines(planes: &Planes, layout: &Layout, size: usize) -> Bins {
    Bins::of(planes, layout.radius, size, |normal| {
        let along = |axis: [f32; 3]| (0..3).map(|k| normal[k] * f64::from(axis[k])).sum::<f64>();
        let [x, y, z] = layout.axes.map(along);
        let length = (x * x + y * y).sqrt();
        let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
        (line_bin([x, y].map(|x| (x * inverse) as f32), size), length, z * f64::from(layout.height))
    })
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    look_up(cx, FORM, lines)
}
