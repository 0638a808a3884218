//! The light's plane, then all rows in parallel.

use crate::shared::light_box::LightBox;
use crate::shared::lu::{BLOCK, Layout, MOST_CPU_BYTES, check_bytes, even};
use crate::shared::lu_fill::{Rows, fill, first_inside, opposite_line};
use glam::DVec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::light_plane::LightPlane;
use shadowgraph_core::problem::{Kind, Problem};

/// Gives `layout` the plane of `samples`; how many lie off it.
pub fn fit(layout: &mut Layout, samples: &[[f32; 3]]) -> usize {
    let plane = LightPlane::of(samples);
    let axes = [plane.axis, plane.normal.cross(plane.axis), plane.normal];
    layout.axes = axes.map(|axis| axis.as_vec3().to_array());
    layout.height = plane.offset_from(DVec3::from(layout.middle.map(f64::from))) as f32;
    samples.iter().filter(|sample| !plane.has(**sample)).count()
}

/// The table's words.
pub fn table(samples: &[[f32; 3]], layout: &Layout, size: usize) -> Vec<u32> {
    let rows = Rows { count: size, size, opposite: opposite_line };
    let [x_axis, y_axis, _] = layout.axes;
    let normal = |row: usize| {
        let turn = std::f64::consts::PI * ((2 * row + 1) as f64 / size as f64 - 1.0);
        let (sin, cos) = (turn.sin() as f32, turn.cos() as f32);
        [0, 1, 2].map(|k| cos * x_axis[k] + sin * y_axis[k])
    };
    fill(layout, samples, rows, normal, |[a, b, c], [x, y, z]| [first_inside(a * x + b * y + c * z, size)])
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let samples = cx.input("light_samples").as_vec3();
    let size = even(cx.params().u32("size"));
    let shape = [samples.len().div_ceil(BLOCK), size, size, 1, 4];
    check_bytes(&shape, MOST_CPU_BYTES)?;
    let mut layout = Layout::new(&LightBox::new(samples));
    let off = fit(&mut layout, samples);
    if off > 0 {
        return Err(Problem::new(Kind::BadValue, "a table over lines needs a planar light")
            .port("light_samples")
            .expected("all light samples in one plane")
            .found(format!("{off} of {} light samples off it", samples.len()))
            .remedy(
                "use lu_table=angles_distance with visibility=lu, or guard this pass with the fact light_is_planar",
            ));
    }
    cx.put("lu", Array::u32(shape, table(samples, &layout, size)));
    let words = layout.to_words();
    cx.put("lu_layout", Array::f32([words.len()], words));
    Ok(())
}
