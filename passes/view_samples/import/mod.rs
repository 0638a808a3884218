//! Pass `view_samples/import`: view-samples from a file, so that any method can be run on the very same points.
//!
//! In: `imported_position`, `imported_normal [P 3] f32, world`, `imported_triangle [P] u32`, optionally `imported_pixel [P] u32`
//! (else row i is pixel i), `triangles [T 3 3]` for their number. Out: the same words as `position`, `normal`, `triangle`, `pixel`.
//!
//! Rows whose triangle has all bits set are background, and their other words are not looked at. Of every other row the position
//! and normal must be finite and the triangle must exist: the CPU names the first row where this fails, the GPU counts such
//! rows.

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use super::{shape_if_connected, shapes};
use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::size::SizeCx;

/// Rows that are no view-samples.
const NOT_FINITE: Counter = Counter {
    name: "not_finite",
    doc: "rows, not background, whose position or normal is not finite",
    kind: CounterKind::MustBeZero("mark such rows as background: all bits of their triangle set"),
};
/// Rows of another scene.
const NO_SUCH_TRIANGLE: Counter = Counter {
    name: "no_such_triangle",
    doc: "rows whose triangle the scene does not have",
    kind: CounterKind::MustBeZero("import view-samples that were dumped from this scene"),
};

/// A file's rows.
pub static PASS: Pass = Pass {
    name: "import",
    stage: &super::STAGE,
    doc: "Takes view-samples from a file.",
    source: "none: a means of comparison",
    ignores: &[
        input::CAMERA.name,
        ports::GBUFFER_POSITION.name,
        ports::GBUFFER_NORMAL.name,
        ports::GBUFFER_TRIANGLE.name,
    ],
    params: &[],
    counters: &[NOT_FINITE, NO_SUCH_TRIANGLE],
    contract: Contract::Exact,
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    // Zero rows when it is not connected: the pass then says what is missing.
    shapes(shape_if_connected(cx, input::IMPORTED_POSITION.name).map_or(0, |shape| shape[0]))
}

/// Number of rows, from the shapes of the connected inputs.
///
/// # Errors
/// An import that is missing, or inputs of different lengths.
fn row_count<'a>(shape: impl Fn(&'static str) -> Option<&'a [usize]>) -> Result<usize, Problem> {
    for port in [input::IMPORTED_POSITION, input::IMPORTED_NORMAL, input::IMPORTED_TRIANGLE] {
        if shape(port.name).is_none() {
            return Err(Problem::new(Kind::Missing, "no view-samples were imported")
                .port(port.name)
                .expected(port.type_text())
                .remedy("give a folder of .npy files with --view-samples, or use view_samples raster"));
        }
    }
    let rows = |name| shape(name).map(|shape| shape[0]);
    let count = rows(input::IMPORTED_POSITION.name).unwrap_or_default();
    for port in [input::IMPORTED_NORMAL, input::IMPORTED_TRIANGLE, input::IMPORTED_PIXEL] {
        match rows(port.name) {
            Some(other) if other != count => {
                return Err(Problem::new(Kind::PortMismatch, "imported arrays have different numbers of rows")
                    .port(port.name)
                    .expected(format!("{count} rows, as {}", input::IMPORTED_POSITION.name))
                    .found(other.to_string()));
            }
            _ => {}
        }
    }
    Ok(count)
}
