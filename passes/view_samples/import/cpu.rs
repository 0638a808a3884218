//! Checks, then copies.

use super::row_count;
use crate::ports;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::NO_TRIANGLE;

/// # Errors
/// The first row that is neither background nor a view-sample of a scene of `triangle_count` triangles.
pub fn check(
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    triangles: &[u32],
    triangle_count: usize,
) -> Result<(), Problem> {
    let is_finite = |vector: &[f32; 3]| vector.iter().all(|x| x.is_finite());
    let is_bad = |row: usize| {
        let triangle = triangles[row];
        let known = (triangle as usize) < triangle_count;
        triangle != NO_TRIANGLE && !(known && is_finite(&positions[row]) && is_finite(&normals[row]))
    };
    let Some(row) = (0..triangles.len()).into_par_iter().find_first(|row| is_bad(*row)) else { return Ok(()) };
    let finite = |name: &str, vector: [f32; 3]| {
        Problem::new(Kind::BadGeometry, format!("row {row} is not finite"))
            .port(name)
            .expected("finite numbers, or the triangle of background (all bits set)")
            .found(format!("{vector:?}"))
    };
    if !is_finite(&positions[row]) {
        return Err(finite(input::IMPORTED_POSITION.name, positions[row]));
    }
    if !is_finite(&normals[row]) {
        return Err(finite(input::IMPORTED_NORMAL.name, normals[row]));
    }
    Err(Problem::new(Kind::BadValue, format!("row {row} names a triangle that the scene does not have"))
        .port(input::IMPORTED_TRIANGLE.name)
        .expected(format!("below {triangle_count}, or {NO_TRIANGLE} for background"))
        .found(triangles[row].to_string())
        .remedy("import view-samples that were dumped from this scene"))
}

/// The pass.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let count = row_count(|name| cx.optional(name).map(Array::shape))?;
    let [position, normal, triangle] =
        [input::IMPORTED_POSITION, input::IMPORTED_NORMAL, input::IMPORTED_TRIANGLE].map(|port| cx.input(port.name));
    let triangle_count = cx.input(input::TRIANGLES.name).dim(0);
    check(position.as_vec3(), normal.as_vec3(), triangle.as_u32(), triangle_count)?;
    let pixel = match cx.optional(input::IMPORTED_PIXEL.name) {
        Some(pixel) => pixel.clone(),
        None => Array::u32([count], (0..count as u32).collect()),
    };
    cx.put(ports::POSITION.name, position.clone());
    cx.put(ports::NORMAL.name, normal.clone());
    cx.put(ports::TRIANGLE.name, triangle.clone());
    cx.put(ports::PIXEL.name, pixel);
    Ok(())
}
