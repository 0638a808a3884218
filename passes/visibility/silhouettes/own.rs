//! Which casters of a cell the plane of a view-sample's own triangle lets through: the rule of
//! [`crate::shared::predicate::OwnPlane`], sixteen casters at a time.

use super::LANES;
use super::cell::Cell;
use crate::shared::predicate::Corners;
use crate::shared::soft::{OwnSides, Soft};
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16};

/// 2^-20 with room: what rounding does to a height over the own plane, of the lengths it is made of.
const ERROR: f64 = 1e-6;

/// The casters let through.
pub struct Admitted {
    /// The triangle they were sorted out for.
    own: Option<u32>,
    /// Sides of its plane.
    pub sides: OwnSides,
    /// By block: those let through for every light sample.
    pub live: Vec<u16>,
    /// Those let through for some light samples only, by slot.
    pub partly: Vec<u32>,
}

/// The own plane in the cell's unit, upright on the side where `predicate::side` is 1.
struct Plane {
    base: [f32; 3],
    normal: [f32; 3],
    slack: f32,
    base_reach: f32,
}

impl Plane {
    fn new(cell: &Cell, own: &Corners) -> Self {
        let minus = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|k| (f64::from(a[k]) - f64::from(b[k])) * cell.scale);
        let (u, v) = (minus(own[1], own[0]), minus(own[2], own[0]));
        let normal = [v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]];
        let size = |v: [f64; 3]| v[0].abs() + v[1].abs() + v[2].abs();
        let long = size(normal);
        // A normal of zeros makes every height undefined: no comparison below is true.
        let base = cell.local(own[0]);
        Self {
            base,
            normal: normal.map(|x| (x / long) as f32),
            slack: (ERROR + 1e-14 * size(u) * size(v) / long) as f32,
            base_reach: base.map(f32::abs).iter().sum(),
        }
    }
}

impl Admitted {
    /// For the first cell.
    pub fn new(soft: &Soft) -> Self {
        Self { own: None, sides: OwnSides::new(soft), live: Vec::new(), partly: Vec::new() }
    }

    /// The cell has changed.
    pub fn forget(&mut self) {
        self.own = None;
    }

    /// Sorts out the casters of `cell` for view-samples on triangle `own`.
    #[inline(always)]
    pub fn turn_to<S: Simd>(&mut self, simd: S, soft: &Soft, cell: &Cell, own: u32) {
        if self.own == Some(own) {
            return;
        }
        self.own = Some(own);
        self.sides.turn_to(soft, own);
        self.live.clear();
        self.partly.clear();
        let Some(corners) = soft.triangles.get(own as usize) else {
            self.live.extend((0..cell.blocks.len()).map(|at| lanes(cell, at)));
            return;
        };
        let plane = Plane::new(cell, corners);
        for at in 0..cell.blocks.len() {
            let [plus, minus, below, above] = heights(simd, cell, at, &plane);
            let (mut through, out) = match self.sides.whole {
                1 => (plus, below),
                -1 => (minus, above),
                _ => (plus & minus, 0),
            };
            let all = lanes(cell, at);
            through &= all;
            let mut doubts = all & !through & !out;
            while doubts != 0 {
                let lane = doubts.trailing_zeros() as usize;
                doubts &= doubts - 1;
                let slot = LANES * at + lane;
                let on = self.sides.corners_on(soft, &soft.triangles[cell.slots[slot].triangle as usize]);
                let is_through = match self.sides.whole {
                    1 => on[1],
                    -1 => on[0],
                    _ => on == [true; 2],
                };
                through |= u16::from(is_through) << lane;
                if self.sides.whole == 0 && !is_through {
                    self.partly.push(slot as u32);
                }
            }
            let own_lane = (0..LANES)
                .filter(|lane| cell.slots.get(LANES * at + lane).is_some_and(|slot| slot.triangle == own))
                .fold(0, |lanes, lane| lanes | 1 << lane);
            self.live.push(through & !own_lane);
        }
        self.partly.retain(|slot| cell.slots[*slot as usize].triangle != own);
    }
}

/// Lanes of block `at` that hold a caster.
#[inline(always)]
fn lanes(cell: &Cell, at: usize) -> u16 {
    let count = cell.slots.len() - LANES * at;
    if count >= LANES { u16::MAX } else { (1 << count) - 1 }
}

/// Casters with a corner surely on the plane's side 1, with one surely on its side -1, and those surely wholly on -1 and on 1.
#[inline(always)]
fn heights<S: Simd>(simd: S, cell: &Cell, at: usize, plane: &Plane) -> [u16; 4] {
    let block = &cell.blocks[at];
    let row = |row: &[f32; LANES]| f32x16::from_slice(simd, row);
    let along = |rows: &[[f32; LANES]; 3], from: [f32; 3]| {
        (row(&rows[0]) - from[0]) * plane.normal[0]
            + (row(&rows[1]) - from[1]) * plane.normal[1]
            + (row(&rows[2]) - from[2]) * plane.normal[2]
    };
    let a = along(&block.corner, plane.base);
    let b = a + along(&block.first, [0.0; 3]);
    let c = b + along(&block.second, [0.0; 3]);
    let slack = (row(&block.reach) + plane.base_reach) * plane.slack;
    let (most, least) = (a.max(b).max(c), a.min(b).min(c));
    [
        most.simd_gt(slack).to_bitmask() as u16,
        least.simd_lt(-slack).to_bitmask() as u16,
        most.simd_lt(-slack).to_bitmask() as u16,
        least.simd_gt(slack).to_bitmask() as u16,
    ]
}
