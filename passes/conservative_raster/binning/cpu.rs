//! Casters in parallel; each walks its footprint and claims a slot in every cell that matters.

use crate::shared::footprint::{Footprint, Grid};
use crate::shared::pair_walk::{MOST_PAIRS, Region, put_pairs, sides};
use crate::shared::pyramid::Reach;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// A footprint, and the smallest depth of its caster, scene units.
struct Touched {
    near: f64,
    footprint: Footprint,
}

impl Region for Touched {
    fn rows(&self) -> [usize; 2] {
        self.footprint.rows
    }
    #[inline(always)]
    fn span(&self, grid: &Grid, row: usize) -> Option<[usize; 2]> {
        self.footprint.span(grid, row)
    }
    #[inline(always)]
    fn is_behind(&self, grid: &Grid, at: [usize; 2], list_far: f32) -> bool {
        grid.is_behind(self.near, list_far, at)
    }
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    run_within(cx, MOST_PAIRS)
}

/// With `most_pairs` in place of [`MOST_PAIRS`].
pub(super) fn run_within(cx: &mut CpuCx, most_pairs: u64) -> Result<(), Problem> {
    let sides = sides(cx);
    put_pairs(cx, most_pairs, &sides, |index, caster| {
        let (space, grid) = (&sides[index].space, &sides[index].grid);
        let corners = space.corners(caster);
        if grid.is_beside(&corners) {
            return None;
        }
        match space.reach_of(caster, corners) {
            Reach::Nothing => None,
            Reach::Anything => Some(Touched { near: f64::MIN, footprint: Footprint::everything(grid) }),
            Reach::Cone(cone) => {
                let footprint = Footprint::new(&cone, grid)?;
                Some(Touched { near: cone.depths()[0], footprint })
            }
        }
    })
}
