//! Which casters of a cell the plane of a view-sample's own triangle lets through: the rule of
//! [`crate::shared::predicate::OwnPlane`], sixteen casters at a time.
//!
//! Where the plane has light samples on both sides, each side lets other casters through: they are counted apart.

use super::LANES;
use super::cell::Cell;
use crate::shared::predicate::Corners;
use crate::shared::soft::{OwnSides, Soft};
use fearless_simd::{Simd, SimdBase, SimdMask, f32x16};

/// 2^-20 with room: what rounding does to a height over the own plane, of the lengths it is made of.
const ERROR: f64 = 1e-6;

/// The casters that the plane of one triangle lets through.
pub struct Run {
    /// Sides of the plane.
    pub sides: OwnSides,
    /// By kind of light sample: by block, casters let through for them.
    live: [Vec<u16>; 3],
    kinds: usize,
}

/// Light samples in which [`Run::live`] differs.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Plus,
    Minus,
    /// In the plane: nothing is held back.
    Level,
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

impl Run {
    /// For any triangle.
    pub fn new(soft: &Soft) -> Self {
        Self { sides: OwnSides::new(soft), live: [const { Vec::new() }; 3], kinds: 0 }
    }

    /// Sorts out the casters of `cell` for view-samples on triangle `own`.
    #[inline(always)]
    pub fn turn_to<S: Simd>(&mut self, simd: S, soft: &Soft, cell: &Cell, own: u32) {
        self.sides.turn_to(soft, own);
        self.live.iter_mut().for_each(Vec::clear);
        self.kinds = 1;
        let Some(corners) = soft.triangles.get(own as usize) else {
            self.live[0].extend((0..cell.blocks.len()).map(|at| cell.lanes(at)));
            return;
        };
        let plane = Plane::new(cell, corners);
        for at in 0..cell.blocks.len() {
            let [plus, minus, below, above] = heights(simd, cell, at, &plane);
            let all = cell.lanes(at);
            let mut through = [plus & all, minus & all];
            let known = [plus | below, minus | above];
            let mut doubts = match self.sides.whole {
                1 => all & !known[0],
                -1 => all & !known[1],
                _ => all & !(known[0] & known[1]),
            };
            while doubts != 0 {
                let lane = doubts.trailing_zeros() as usize;
                doubts &= doubts - 1;
                let triangle = cell.slots[LANES * at + lane].triangle;
                let on = self.sides.corners_on(soft, &soft.triangles[triangle as usize]);
                through[0] = through[0] & !(1 << lane) | u16::from(on[1]) << lane;
                through[1] = through[1] & !(1 << lane) | u16::from(on[0]) << lane;
            }
            let itself = (0..LANES)
                .filter(|lane| cell.slots.get(LANES * at + lane).is_some_and(|slot| slot.triangle == own))
                .fold(0, |lanes, lane| lanes | 1 << lane);
            match self.sides.whole {
                1 => self.live[0].push(through[0] & !itself),
                -1 => self.live[0].push(through[1] & !itself),
                _ => {
                    self.live[0].push(through[0] & !itself);
                    self.live[1].push(through[1] & !itself);
                    self.live[2].push(all & !itself);
                }
            }
        }
        if self.sides.whole == 0 {
            let is_level = (0..soft.light.words()).any(|word| self.allowed_of(soft, Kind::Level, word) != 0);
            self.kinds = match (is_level, self.live[0] == self.live[1] && self.live[1] == self.live[2]) {
                (_, true) => 1,
                (false, _) => 2,
                (true, _) => 3,
            };
        }
    }

    /// How many kinds of light samples differ in what is let through.
    pub fn kinds(&self) -> usize {
        self.kinds
    }

    /// Casters let through for light samples of `kind`, by block.
    pub fn live(&self, kind: usize) -> &[u16] {
        &self.live[kind]
    }

    /// Light samples of `kind` in `word`.
    pub fn allowed(&self, soft: &Soft, kind: usize, word: usize) -> u32 {
        match (self.kinds, kind) {
            (1, _) => soft.light.used(word),
            (_, 0) => self.allowed_of(soft, Kind::Plus, word),
            (_, 1) => self.allowed_of(soft, Kind::Minus, word),
            _ => self.allowed_of(soft, Kind::Level, word),
        }
    }

    fn allowed_of(&self, soft: &Soft, kind: Kind, word: usize) -> u32 {
        // What the rule admits of a caster with corners on one side alone, and of one with corners on neither.
        let admitted = |on| self.sides.admitted(on, word) & soft.light.used(word);
        let level = admitted([false, false]);
        match kind {
            Kind::Level => level,
            Kind::Plus => admitted([false, true]) & !level,
            Kind::Minus => admitted([true, false]) & !level,
        }
    }
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
