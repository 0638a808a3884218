//! Stage `list_build`: Counts the view-samples of each light texel and gives each its place in the list (Sintorn 2008, section 3.1).

pub mod atomic_counters;
mod place;
pub mod sort;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Counter, CounterKind, Pass};
use shadowgraph_core::shared::PRELUDE;
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "list_build",
    doc: "Counts the view-samples of each light texel and gives each its place in the list (Sintorn 2008, section 3.1).",
    ports: &[
        ports::POSITION.read(),
        ports::SAMPLE_STATE.read(),
        ports::LIGHT_FRAME.read(),
        ports::CELL,
        ports::SLOT,
        ports::LIST_LENGTH,
        ports::LIST_FAR,
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&atomic_counters::PASS, &sort::PASS];

/// Side of the light's image.
const SIZE: ParamSpec = ParamSpec {
    name: "size",
    range: Range::U32 { min: 1, max: 4096, default: 512 },
    unit: "light texels a side",
    doc: "light texels along each side of a face; as it grows lists get shorter, so fewer (view-sample, caster) tests, but \
          casters touch more cells and tables of F size size words grow",
};

/// Kept view-samples that no face sees.
const UNPLACED: Counter = Counter {
    name: "unplaced",
    doc: "kept view-samples that no face of the light frame sees",
    kind: CounterKind::MustBeZero("use light_frame/six_faces, which sees all directions"),
};

/// The longest list.
const LONGEST: Counter =
    Counter { name: "longest_list", doc: "view-samples in the fullest cell", kind: CounterKind::Most };

/// WGSL that both passes join before their kernels: projection, and the test of a view-sample.
const PLACE: [&str; 3] = [PRELUDE, crate::shared::light_frame::WGSL, include_str!("place.wgsl")];

/// A cell and a slot a view-sample, a length and a depth a cell.
fn size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    let count = cx.dim(ports::POSITION.name, 0);
    let side = cx.params.u32(SIZE.name) as usize;
    let cells = vec![cx.dim(ports::LIGHT_FRAME.name, 0), side, side];
    vec![
        (ports::CELL.name, vec![count]),
        (ports::SLOT.name, vec![count]),
        (ports::LIST_LENGTH.name, cells.clone()),
        (ports::LIST_FAR.name, cells),
    ]
}

/// What a pass of this stage makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Lists {
    /// Cell of each view-sample, `NO_CELL` where it is in none.
    pub cell: Vec<u32>,
    /// Place of each listed view-sample in its list.
    pub slot: Vec<u32>,
    /// View-samples in each cell.
    pub length: Vec<u32>,
    /// Largest depth in each cell, scene units; 0 where the cell is empty.
    pub far: Vec<f32>,
    /// Kept view-samples that no face sees.
    pub unplaced: u64,
}

impl Lists {
    fn put(self, cx: &mut CpuCx) {
        let side = cx.params().u32(SIZE.name) as usize;
        let cells = vec![self.length.len() / (side * side), side, side];
        cx.count(UNPLACED.name, self.unplaced);
        cx.count(LONGEST.name, u64::from(self.length.iter().copied().max().unwrap_or(0)));
        cx.put(ports::CELL.name, Array::u32([self.cell.len()], self.cell));
        cx.put(ports::SLOT.name, Array::u32([self.slot.len()], self.slot));
        cx.put(ports::LIST_LENGTH.name, Array::u32(cells.clone(), self.length));
        cx.put(ports::LIST_FAR.name, Array::f32(cells, self.far));
    }
}
