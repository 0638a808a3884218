//! Borders, the cells that their regions touch, and the view-samples in these and near their own triangle's edges.

use super::SUNK_ULPS;
use crate::ports;
use crate::shared::contact::step;
use crate::shared::face_light::Bounds;
use crate::shared::influence::face_lights;
use crate::shared::light_bound::Shape;
use crate::shared::light_box::LightBox;
use crate::shared::neighbours::NONE;
use crate::shared::pair_walk::{mark_cells, sides};
use crate::shared::predicate::Corners;
use crate::shared::pyramid::{cross, dot, size};
use crate::shared::view_planes::side_of_light;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{KEPT, NO_CELL};

/// Regions as `conservative_raster/influence` makes them by default.
pub(super) const SHAPE: Shape = Shape::Ellipsoid;
/// The same.
pub(super) const BOUNDS: Bounds = Bounds { sides: 6, is_quad: false, cut: true };

/// What may part the light.
#[derive(Debug, Default)]
pub(super) struct Borders {
    /// Triangles that are not firm, and edges as triangles whose last two corners are one.
    pub triangles: Vec<Corners>,
    /// Edges of casting triangles.
    pub edges: usize,
    /// Those of them that are not inner.
    pub silhouettes: usize,
    /// Triangles that are not firm.
    pub cut: usize,
}

impl Borders {
    /// Those that `light` sees.
    pub fn new(triangles: &[Corners], caster_state: &[u32], across: &[[u32; 3]], light: &LightBox) -> Self {
        let sides: Vec<i32> = triangles.par_iter().map(|corners| side_of_light(corners, light)).collect();
        let mut borders = Self::default();
        for triangle in (0..triangles.len()).filter(|triangle| caster_state[*triangle] != 0) {
            let corners = &triangles[triangle];
            if sides[triangle] == 0 {
                borders.triangles.push(*corners);
                borders.cut += 1;
            }
            for edge in 0..3 {
                let other = across[triangle][edge];
                // The other of two tells of their edge.
                if other != NONE && (other as usize) < triangle {
                    continue;
                }
                borders.edges += 1;
                let side = if other == NONE { 0 } else { sides[other as usize] };
                if side == 0 || side != sides[triangle] {
                    let [a, b] = [corners[edge], corners[(edge + 1) % 3]];
                    borders.triangles.push([a, b, b]);
                    borders.silhouettes += 1;
                }
            }
        }
        borders
    }
}

/// Whether the triangle that a view-sample lies on may part the light for it.
pub(super) fn own_parts(position: [f32; 3], own: &Corners, light: &LightBox) -> bool {
    let side = side_of_light(own, light);
    let edge = |k: usize| [position, own[k], own[(k + 1) % 3]];
    side == 0 || is_sunk(position, own, side) || (0..3).any(|k| side_of_light(&edge(k), light) == 0)
}

/// Whether a view-sample is further below its own plane than rounding leaves it; `side` as of [`side_of_light`].
fn is_sunk(position: [f32; 3], own: &Corners, side: i32) -> bool {
    let minus = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|k| f64::from(a[k]) - f64::from(b[k]));
    let [a, b, c] = *own;
    let normal = cross(minus(b, a), minus(c, a));
    // The light is where the normal does not point when its side is 1.
    let height = -f64::from(side) * dot(normal, minus(position, a));
    let step = step(SUNK_ULPS, own.iter().chain([&position]));
    height < -step * size(normal)
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let triangles: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let across: &[[u32; 3]] = bytemuck::cast_slice(cx.input(ports::ACROSS.name).as_u32());
    let samples = cx.input(input::LIGHT_SAMPLES.name).as_vec3();
    let sample_count = cx.input(ports::POSITION.name).dim(0);
    if triangles.is_empty() || samples.is_empty() || sample_count == 0 {
        cx.put(ports::PENUMBRA_STATE.name, Array::u32([sample_count], vec![0; sample_count]));
        return Ok(());
    }
    let light = LightBox::new(samples);
    let borders = Borders::new(triangles, cx.input(ports::CASTER_STATE.name).as_u32(), across, &light);

    // Cells that a border's region touches.
    let faces = sides(cx);
    let lights = face_lights(&faces, samples, SHAPE, BOUNDS);
    let list_length = cx.input(ports::LIST_LENGTH.name).as_u32();
    let list_far = cx.input(ports::LIST_FAR.name).as_f32();
    let marks = mark_cells(&borders.triangles, &faces, list_length, list_far, |index, border| {
        let side = &faces[index];
        lights[index].region(&side.space.corners(border), &side.grid)
    });

    // View-samples in these, in no cell, or parted by their own triangle.
    let (position, own) = (cx.input(ports::POSITION.name).as_vec3(), cx.input(ports::TRIANGLE.name).as_u32());
    let (state, cell) = (cx.input(ports::SAMPLE_STATE.name).as_u32(), cx.input(ports::CELL.name).as_u32());
    let is_partial = |row: usize| {
        state[row] == KEPT
            && (cell[row] == NO_CELL
                || marks[cell[row] as usize] != 0
                || triangles.get(own[row] as usize).is_some_and(|own| own_parts(position[row], own, &light)))
    };
    let states: Vec<u32> =
        (0..position.len()).into_par_iter().with_min_len(1 << 12).map(|row| u32::from(is_partial(row))).collect();

    cx.count("edges", borders.edges as u64);
    cx.count("silhouette_edges", borders.silhouettes as u64);
    cx.count("cut_triangles", borders.cut as u64);
    cx.count("cells", list_length.iter().filter(|length| **length > 0).count() as u64);
    cx.count("penumbra_cells", marks.iter().map(|mark| u64::from(*mark)).sum());
    cx.count("partial_samples", states.iter().map(|state| u64::from(*state)).sum());
    cx.put(ports::PENUMBRA_STATE.name, Array::u32([states.len()], states));
    Ok(())
}
