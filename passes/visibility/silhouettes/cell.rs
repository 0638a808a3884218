//! One cell: its view-samples, its casters as they see them, and what is the same for all of them.
//!
//! Lengths are in the cell's own unit, a power of two near the distance to the light, from the cell's own origin: differences are
//! taken in f64 and rounded once, so a caster's place errs by 2^-24 of its distance from the cell.
//!
//! A caster is left out where all of it is beside the shaft from the box of view-samples to the box of light samples, behind all of
//! the view-samples or beyond all of the light. One that may reach as far as the light, or is no triangle that f32 can be trusted
//! with, is kept apart and tested singly.

use super::LANES;
use super::edges::Edges;
use crate::shared::light_box::LightBox;
use crate::shared::predicate::Corners;

/// Sixteen casters, by lane.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Block {
    /// First corner, from the cell's origin.
    pub corner: [[f32; LANES]; 3],
    /// From the first corner to the second.
    pub first: [[f32; LANES]; 3],
    /// From the second corner to the third.
    pub second: [[f32; LANES]; 3],
    /// (V1 - V0) x (V2 - V0).
    pub normal: [[f32; LANES]; 3],
    /// Bound on the error of a value of an edge's plane, for a point at a distance of one.
    pub slack: [f32; LANES],
    /// Bound on the error of the height of a view-sample over the caster's plane.
    pub facing_slack: [f32; LANES],
    /// Sum of lengths: where the corners may be.
    pub reach: [f32; LANES],
}

impl Block {
    const EMPTY: Self = Self {
        corner: [[0.0; LANES]; 3],
        first: [[0.0; LANES]; 3],
        second: [[0.0; LANES]; 3],
        normal: [[0.0; LANES]; 3],
        slack: [0.0; LANES],
        facing_slack: [0.0; LANES],
        reach: [0.0; LANES],
    };
}

/// What is known of a caster by its place.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// Its index.
    pub triangle: u32,
    /// Its edges by their number in the cell, as [`Edges::of`].
    pub edges: [u32; 3],
}

/// Casters and view-samples of a cell.
pub struct Cell {
    /// Origin, world space.
    pub origin: [f32; 3],
    /// Cell units in a scene unit.
    pub scale: f64,
    /// Largest |x| + |y| + |z| of a view-sample.
    pub views_reach: f32,
    /// Least and largest coordinates of the view-samples.
    pub views: [[f32; 3]; 2],
    /// Casters, sixteen to a block.
    pub blocks: Vec<Block>,
    /// By caster.
    pub slots: Vec<Slot>,
    /// Casters to be tested singly.
    pub singles: Vec<u32>,
    /// By number in the cell: the edge, and its ends.
    edges: Vec<u32>,
    /// See `edges`.
    pub ends: Vec<[[f32; 3]; 2]>,
    /// By edge: its number in the cell, if it is of this cell.
    number: Vec<u32>,
}

/// Half-spaces that hold the shaft of a cell: by direction across it, slope, least height, and what rounding is to be multiplied by.
struct Shaft {
    axes: [[f64; 3]; 3],
    slope: [f64; 8],
    least: [f64; 8],
    steep: [f64; 8],
    /// Least height of a view-sample along the axis.
    low: f64,
    /// Least and largest height of a light sample.
    light: [f64; 2],
}

/// Room for rounding in f64, of the size of what is compared.
const ROOM: f64 = 1e-12;
/// 2^-18 with room: see [`super::meet`].
const SLACK: f64 = 4e-6;
/// 2^-20 with room.
const FACING_SLACK: f64 = 1e-6;
/// Casters larger or smaller than this, or farther, in cell units, are left to single tests: their products may leave f32.
const LARGEST: f64 = 1e7;
const SMALLEST: f64 = 1e-9;

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn minus(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    [f64::from(a[0]) - f64::from(b[0]), f64::from(a[1]) - f64::from(b[1]), f64::from(a[2]) - f64::from(b[2])]
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn size(a: [f64; 3]) -> f64 {
    a[0].abs() + a[1].abs() + a[2].abs()
}

/// The eight directions across a shaft.
#[inline(always)]
fn across(x: f64, y: f64) -> [f64; 8] {
    [x, -x, y, -y, x + y, x - y, y - x, -x - y]
}

impl Shaft {
    /// Of view-samples in the box `low` to `high` from `origin`, and of `light`; none where the light is not in front of all of them.
    fn new(origin: [f32; 3], views: &[[f64; 3]], light: &LightBox) -> Option<Self> {
        let to_light = minus(light.middle, origin);
        let length = dot(to_light, to_light).sqrt();
        if !(length.is_normal() && light.radius.is_finite()) {
            return None;
        }
        let z = to_light.map(|x| x / length);
        let helper = if z[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let x = cross(helper, z);
        let long = dot(x, x).sqrt();
        let x = x.map(|c| c / long);
        let axes = [x, cross(z, x), z];
        let mut least = [[f64::MAX; 2]; 8];
        let mut low = f64::MAX;
        let mut high = f64::MIN;
        let mut size_of_all = length + light.radius;
        let heights = [length - light.radius, length + light.radius];
        let corners: Vec<[f64; 3]> = views.iter().map(|v| axes.map(|axis| dot(axis, *v))).collect();
        for [x, y, z] in &corners {
            for (side, least) in across(*x, *y).into_iter().zip(&mut least) {
                least[0] = least[0].min(side);
            }
            (low, high) = (low.min(*z), high.max(*z));
            size_of_all = size_of_all.max(x.abs() + y.abs() + z.abs());
        }
        let room = ROOM * size_of_all;
        if high + room >= heights[0] - room {
            return None;
        }
        // The light is in the ball of its radius about the axis; views are in their box.
        let sides = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| {
            let of_light = -light.radius * if k < 4 { 1.0 } else { std::f64::consts::SQRT_2 };
            let slope = (of_light - least[k][0]) / (length - 0.5 * (low + high));
            let of_light = heights.map(|z| of_light - slope * z);
            let of_views = [low, high].map(|z| least[k][0] - slope * z);
            let least = of_light[0].min(of_light[1]).min(of_views[0]).min(of_views[1]);
            [slope, least - room * (1.0 + slope.abs())]
        });
        let [slope, least] = [sides.map(|side| side[0]), sides.map(|side| side[1])];
        let steep = slope.map(|slope| 4.0 * (1.0 + slope.abs()));
        Some(Self { axes, slope, least, steep, low: low - room, light: [heights[0] - room, heights[1] + room] })
    }

    /// Whether a caster with these corners is left out, and whether it is before the light.
    #[inline(always)]
    fn place(&self, corners: &[[f64; 3]; 3]) -> (bool, bool) {
        // Coordinates are numbers: plain comparisons, which fit a register of eight, will do.
        let greater = |a: f64, b: f64| if a > b { a } else { b };
        let mut most = [f64::MIN; 8];
        let (mut low, mut high, mut far) = (f64::MAX, f64::MIN, 0.0f64);
        for corner in corners {
            far = greater(far, size(*corner));
            let (x, y, z) = (dot(self.axes[0], *corner), dot(self.axes[1], *corner), dot(self.axes[2], *corner));
            let sides = across(x, y);
            for k in 0..8 {
                most[k] = greater(most[k], sides[k] - self.slope[k] * z);
            }
            (low, high) = (-greater(-low, -z), greater(high, z));
        }
        let room = ROOM * far;
        let mut out = high + room < self.low || low - room > self.light[1];
        for (most, (steep, least)) in most.iter().zip(self.steep.iter().zip(&self.least)) {
            out |= most + room * steep < *least;
        }
        (out, high + room < self.light[0])
    }
}

impl Cell {
    /// For `edges` in all.
    pub fn new(edges: usize) -> Self {
        Self {
            origin: [0.0; 3],
            scale: 1.0,
            views_reach: 0.0,
            views: [[0.0; 3]; 2],
            blocks: Vec::new(),
            slots: Vec::new(),
            singles: Vec::new(),
            edges: Vec::new(),
            ends: Vec::new(),
            number: vec![u32::MAX; edges],
        }
    }

    /// Lanes of block `at` that hold a caster.
    #[inline(always)]
    pub fn lanes(&self, at: usize) -> u16 {
        let count = self.slots.len() - LANES * at;
        if count >= LANES { u16::MAX } else { (1 << count) - 1 }
    }

    /// A point from the origin, in cell units.
    #[inline(always)]
    pub fn local(&self, point: [f32; 3]) -> [f32; 3] {
        let [x, y, z] = minus(point, self.origin);
        [(x * self.scale) as f32, (y * self.scale) as f32, (z * self.scale) as f32]
    }

    /// Turns to the view-samples at `views` and to `casters`.
    #[inline(always)]
    pub fn turn_to(
        &mut self,
        views: &[[f32; 3]],
        light: &LightBox,
        triangles: &[Corners],
        edges: &Edges,
        casters: &[u32],
    ) {
        for edge in self.edges.drain(..) {
            self.number[edge as usize] = u32::MAX;
        }
        self.ends.clear();
        self.blocks.clear();
        self.slots.clear();
        self.singles.clear();
        self.origin = views[views.len() / 2];
        let offsets: Vec<[f64; 3]> = views.iter().map(|view| minus(*view, self.origin)).collect();
        let shaft = Shaft::new(self.origin, &offsets, light);
        let far = size(minus(light.middle, self.origin)).max(light.radius);
        let exponent = far.log2().floor();
        let shaft = shaft.filter(|_| exponent.is_finite());
        self.scale = if shaft.is_some() { (-exponent).exp2() } else { 1.0 };
        let views_reach = offsets.iter().map(|offset| size(*offset) * self.scale).fold(0.0, f64::max) * (1.0 + 1e-6);
        let shaft = shaft.filter(|_| views_reach < LARGEST);
        self.views_reach = views_reach as f32;
        let local = |view: &[f32; 3]| self.local(*view);
        self.views = views.iter().map(local).fold([[f32::MAX; 3], [f32::MIN; 3]], |[low, high], p| {
            [[0, 1, 2].map(|k| low[k].min(p[k])), [0, 1, 2].map(|k| high[k].max(p[k]))]
        });
        for &triangle in casters {
            let corners = &triangles[triangle as usize];
            let Some(shaft) = shaft.as_ref().filter(|_| corners.as_flattened().iter().all(|x| x.is_finite())) else {
                self.singles.push(triangle);
                continue;
            };
            let from_origin =
                [minus(corners[0], self.origin), minus(corners[1], self.origin), minus(corners[2], self.origin)];
            let (out, before) = shaft.place(&from_origin);
            if out {
                continue;
            }
            if !before || !self.push(corners, &from_origin, views_reach, triangle, edges) {
                self.singles.push(triangle);
            }
        }
    }

    /// Enters a caster; whether f32 can be trusted with it.
    #[inline(always)]
    fn push(&mut self, corners: &Corners, from: &[[f64; 3]; 3], views: f64, triangle: u32, edges: &Edges) -> bool {
        let scaled = |[x, y, z]: [f64; 3]| [x * self.scale, y * self.scale, z * self.scale];
        let corner = scaled(from[0]);
        let first = scaled(minus(corners[1], corners[0]));
        let second = scaled(minus(corners[2], corners[1]));
        let normal = cross(first, scaled(minus(corners[2], corners[0])));
        let sides = size(first) + size(second);
        let reach = size(corner) + sides;
        if !(sides > SMALLEST && reach < LARGEST) {
            return false;
        }
        let lane = self.slots.len() % LANES;
        if lane == 0 {
            self.blocks.push(Block::EMPTY);
        }
        let Some(block) = self.blocks.last_mut() else { return false };
        for k in 0..3 {
            block.corner[k][lane] = corner[k] as f32;
            block.first[k][lane] = first[k] as f32;
            block.second[k][lane] = second[k] as f32;
            block.normal[k][lane] = normal[k] as f32;
        }
        let far = reach + views;
        block.slack[lane] = (SLACK * far * sides) as f32;
        block.facing_slack[lane] = (far * (FACING_SLACK * size(normal) + 1e-14 * sides * sides)) as f32;
        block.reach[lane] = reach as f32;
        let mut numbers = edges.of[triangle as usize];
        for edge in &mut numbers {
            let number = &mut self.number[*edge as usize / 2];
            if *number == u32::MAX {
                *number = self.edges.len() as u32;
                self.edges.push(*edge / 2);
                self.ends.push(edges.ends[*edge as usize / 2]);
            }
            *edge = 2 * *number + *edge % 2;
        }
        self.slots.push(Slot { triangle, edges: numbers });
        true
    }
}
