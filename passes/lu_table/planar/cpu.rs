//! The light's plane, then all rows in parallel.

use crate::shared::light_box::LightBox;
use crate::shared::lu::{BLOCK, Layout, MOST_CPU_BYTES, check_bytes, even};
use crate::shared::lu_fill::{Rows, fill, first_inside, opposite_line};
use glam::DVec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::{Kind, Problem};

/// How far off its plane a light sample may lie, of R.
const OFF_PLANE: f64 = 1e-6;

/// Axes of the plane of `samples`, and how many lie off it.
pub fn plane(samples: &[[f32; 3]], layout: &Layout) -> ([[f32; 3]; 3], usize) {
    let middle = DVec3::from(layout.middle.map(f64::from));
    let offsets: Vec<DVec3> = samples.iter().map(|sample| DVec3::from(sample.map(f64::from)) - middle).collect();
    // The first of the longest, as the kernel takes it.
    let longest = |vectors: &mut dyn Iterator<Item = DVec3>| {
        vectors.fold(DVec3::ZERO, |best, one| if one.length_squared() > best.length_squared() { one } else { best })
    };
    let far = longest(&mut offsets.iter().copied());
    let x = far.try_normalize().unwrap_or(DVec3::X);
    // A light that is a segment lies in many planes: any will do.
    let any = x.cross(if x.x.abs() > 0.5 { DVec3::Y } else { DVec3::X }).normalize();
    let across = longest(&mut offsets.iter().map(|offset| x.cross(*offset)));
    let normal = if across.length() > OFF_PLANE * far.length() { across.normalize() } else { any };
    // One of two.
    let normal = if normal.dot(any) < 0.0 { -normal } else { normal };
    let off = offsets.iter().filter(|offset| offset.dot(normal).abs() > OFF_PLANE * far.length()).count();
    ([x, normal.cross(x), normal].map(|axis| axis.as_vec3().to_array()), off)
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
    let (axes, off) = plane(samples, &layout);
    if off > 0 {
        return Err(Problem::new(Kind::BadValue, "a table over lines needs a planar light")
            .port("light_samples")
            .expected("all light samples in one plane")
            .found(format!("{off} of {} light samples off it", samples.len()))
            .remedy(
                "use lu_table=angles_distance with visibility=lu, or guard this pass with the fact light_is_planar",
            ));
    }
    layout.axes = axes;
    cx.put("lu", Array::u32(shape, table(samples, &layout, size)));
    let words = layout.to_words();
    cx.put("lu_layout", Array::f32([words.len()], words));
    Ok(())
}
