//! The plane of an own triangle: heights of corners in the cluster's space with bounds on rounding, sixteen planes at once; and exact sides.

use super::LANES;
use super::groups::{Blocks, Frame, cross, dot, size};
use super::own::World;
use super::shaft::{PLANE_ERROR, dot_one, load};
use crate::shared::predicate::{Corners, side};
use fearless_simd::{Simd, SimdBase, SimdMask, u32x16};
use std::collections::HashMap;

/// Answers of the exact predicate that a thread keeps at most.
const MOST_KNOWN: usize = 1 << 18;

/// An own triangle.
pub struct Plane {
    /// Its index.
    pub triangle: u32,
    /// Unit normal, towards the middle of the light, and constant; zero when in doubt.
    pub normal: [f32; 3],
    /// See `normal`.
    pub constant: f32,
    /// Bound on the error of a height, as a share of the sizes of both points.
    pub error: f32,
    /// Bounds the sums of absolute coordinates of its corners.
    pub size: f32,
    /// The side of the world's plane that is above here: 1 or -1.
    up: i32,
    /// All light samples are above for certain.
    pub lit: bool,
    /// Where the world's plane is one of equal x, y or z.
    level: Option<Level>,
    /// Sides of all light samples, block by block; made when first asked for.
    sides: Vec<Sides>,
}

/// Light samples of a block strictly above a plane, and strictly below, a bit each.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sides {
    /// Above.
    pub above: u16,
    /// Below.
    pub below: u16,
}

/// A plane `p[axis] = at`: on which side a point is needs a comparison. Floors and walls often are such, and others level with them.
#[derive(Clone, Copy, Debug)]
struct Level {
    axis: usize,
    at: f32,
    /// The side beyond: 1, -1, or 0 for a degenerate triangle.
    beyond: i32,
}

impl Level {
    fn of(corners: &Corners) -> Option<Self> {
        let axis = (0..3).find(|&axis| corners.iter().all(|corner| corner[axis] == corners[0][axis]))?;
        let at = corners[0][axis];
        // The side is linear in the distance: one point off the plane tells its sign.
        let mut off = corners[0];
        off[axis] = if at > 0.0 { at.next_down() } else { at.next_up() };
        let beyond = side(corners, off) * if at > 0.0 { -1 } else { 1 };
        Some(Self { axis, at, beyond })
    }

    /// As [`side`].
    fn side(&self, point: [f32; 3]) -> i32 {
        let x = point[self.axis];
        self.beyond * (i32::from(x > self.at) - i32::from(x < self.at))
    }
}

/// Planes by lanes.
#[derive(Default)]
pub struct Rows {
    /// Normal, constant, error, size.
    of: [Vec<f32>; 6],
    /// The triangle of each.
    triangle: Vec<u32>,
}

/// The caster has corners strictly above.
pub const ABOVE: u8 = 1;
/// And below.
pub const BELOW: u8 = 2;

/// What sixteen planes see of a caster's corners for certain, a bit each.
pub struct Seen {
    /// One above.
    pub above: u16,
    /// One below.
    pub below: u16,
    /// All below.
    pub not_above: u16,
    /// All above.
    pub not_below: u16,
    /// It is the plane's own triangle.
    pub mine: u16,
}

impl Rows {
    /// Those of `planes`.
    pub fn fill(&mut self, planes: &[Plane]) {
        let padded = planes.len().next_multiple_of(LANES);
        for row in &mut self.of {
            row.clear();
        }
        self.triangle.clear();
        for plane in planes {
            let [x, y, z] = plane.normal;
            for (row, value) in self.of.iter_mut().zip([x, y, z, plane.constant, plane.error, plane.size]) {
                row.push(value);
            }
            self.triangle.push(plane.triangle);
        }
        for row in &mut self.of {
            row.resize(padded, 0.0);
        }
        self.triangle.resize(padded, u32::MAX);
    }

    /// Planes `first..first + 16`.
    #[inline(always)]
    pub fn heights<S: Simd>(&self, simd: S, corners: &[[f32; 3]; 3], reach: f32, id: u32, first: usize) -> Seen {
        let [x, y, z, constant, error, size] = &self.of;
        let normal = [load(simd, x, first), load(simd, y, first), load(simd, z, first)];
        let constant = load(simd, constant, first);
        let room = load(simd, error, first) * (load(simd, size, first) + reach);
        let heights = [
            dot_one(corners[0], normal) + constant,
            dot_one(corners[1], normal) + constant,
            dot_one(corners[2], normal) + constant,
        ];
        let low = heights[0].min(heights[1]).min(heights[2]);
        let high = heights[0].max(heights[1]).max(heights[2]);
        let triangles = u32x16::from_slice(simd, &self.triangle[first..first + LANES]);
        Seen {
            above: high.simd_gt(room).to_bitmask() as u16,
            below: (low + room).simd_lt(0.0).to_bitmask() as u16,
            not_above: (high + room).simd_lt(0.0).to_bitmask() as u16,
            not_below: low.simd_gt(room).to_bitmask() as u16,
            mine: triangles.simd_eq(id).to_bitmask() as u16,
        }
    }
}

impl Plane {
    /// That of `triangle`. `light`: corners of the light's box in the cluster's space.
    pub fn new(triangle: u32, corners: &Corners, world: &World, frame: &Frame, light: ([f32; 3], [f32; 3])) -> Self {
        let units = corners.map(|p| world.unit(p));
        let origin = frame.point(units[0]);
        let [g, h] = [1, 2].map(|k| frame.turn([0, 1, 2].map(|axis| units[k][axis] - units[0][axis])));
        let normal = cross(g, h);
        let length = dot(normal, normal).sqrt();
        let share = size(g) * size(h) / length;
        let mut plane = Self {
            triangle,
            normal: [0.0; 3],
            constant: 0.0,
            error: PLANE_ERROR * share,
            size: size(origin) + size(g) + size(h),
            up: 1,
            lit: false,
            level: Level::of(corners),
            sides: Vec::new(),
        };
        if !(share < 1e4 && length > 1e-30) {
            return plane;
        }
        let middle = [0, 1, 2].map(|k| 0.5 * (light.0[k] + light.1[k]));
        let half = [0, 1, 2].map(|k| 0.5 * (light.1[k] - light.0[k]));
        let unit = normal.map(|x| x / length);
        let height = dot(unit, middle) - dot(unit, origin);
        let turn = if height < 0.0 { -1.0 } else { 1.0 };
        plane.normal = unit.map(|x| turn * x);
        plane.constant = -dot(plane.normal, origin);
        // orient3d is positive below a triangle that turns counter-clockwise seen from above.
        plane.up = if height < 0.0 { 1 } else { -1 };
        let spread = unit[0].abs() * half[0] + unit[1].abs() * half[1] + unit[2].abs() * half[2];
        plane.lit = height.abs() - spread > plane.error * (size(middle) + size(half) + plane.size);
        plane
    }

    /// Which sides of the plane the caster has corners on, exactly.
    pub fn corners(&self, world: &World, known: &mut HashMap<u64, u8>, id: u32) -> u8 {
        let sides_of = |side: &dyn Fn([f32; 3]) -> i32| {
            world.triangles[id as usize].iter().fold(0, |bits, corner| match side(*corner) {
                1 => bits | ABOVE,
                -1 => bits | BELOW,
                _ => bits,
            })
        };
        let bits = if let Some(level) = self.level {
            sides_of(&|corner| level.side(corner))
        } else {
            let key = u64::from(self.triangle) << 32 | u64::from(id);
            if let Some(bits) = known.get(&key) {
                *bits
            } else {
                if known.len() >= MOST_KNOWN {
                    known.clear();
                }
                let own = &world.triangles[self.triangle as usize];
                let bits = sides_of(&|corner| if own.contains(&corner) { 0 } else { side(own, corner) });
                known.insert(key, bits);
                bits
            }
        };
        let (up, down) = (bits & ABOVE, bits & BELOW);
        // What is known is about the plane as the predicate turns it.
        if self.up > 0 { up | down } else { (up << 1) | (down >> 1) }
    }

    /// On which side each block of light samples is, exactly.
    #[inline(always)]
    pub fn sides<S: Simd>(&mut self, simd: S, world: &World, lights: &Blocks) -> &[Sides] {
        if self.sides.is_empty() {
            let own = &world.triangles[self.triangle as usize];
            for (block, order) in lights.index.chunks_exact(LANES).enumerate() {
                let [x, y, z] = &lights.at;
                let first = block * LANES;
                let at = [load(simd, x, first), load(simd, y, first), load(simd, z, first)];
                let room = (at[0].abs() + at[1].abs() + at[2].abs() + self.size) * self.error;
                let height = dot_one(self.normal, at) + self.constant;
                let mut sides = Sides {
                    above: height.simd_gt(room).to_bitmask() as u16,
                    below: (height + room).simd_lt(0.0).to_bitmask() as u16,
                };
                let mut doubt = !(sides.above | sides.below);
                while doubt != 0 {
                    let lane = doubt.trailing_zeros() as usize;
                    doubt &= doubt - 1;
                    let light = world.lights[order[lane] as usize];
                    let side = self.up * self.level.map_or_else(|| side(own, light), |level| level.side(light));
                    sides.above |= u16::from(side > 0) << lane;
                    sides.below |= u16::from(side < 0) << lane;
                }
                self.sides.push(sides);
            }
        }
        &self.sides
    }
}
