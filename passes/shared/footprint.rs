//! The texels of a face that a caster can matter to: rows, and one span of columns in each.
//!
//! Superset. A view-sample was put into its texel by f32 arithmetic, so its direction may differ from the true one by up to
//! 8e-7 of its length ([`crate::shared::light_frame::uv_pad`]); a direction counts as covered when each of the three edge
//! functions n . (u, v, 1) is above -[`SLACK`] |n| (1 + |u| + |v|), which is more. Texel squares are padded by the rounding of their
//! borders. Border texels reach as far as view-samples do.

use super::light_frame::Face;
use super::pyramid::{Cone, WILD, size};

/// Directions may be off by this much of their length.
pub(super) const SLACK: f64 = 2e-6;

/// A depth may be off by this much of the distance: five f32 roundings, and the axes.
const DEPTH_ERROR: f64 = 5e-7;

/// The texels of one face.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Texels a side.
    pub side: usize,
    /// Smallest u and v of the window.
    low: [f64; 2],
    /// Extent of a texel in u and v.
    texel: [f64; 2],
    /// Texel borders may be off by this much, texels.
    pad: f64,
    /// Smallest and largest u, then v, at which view-samples may be.
    pub(super) reach: [[f64; 2]; 2],
    /// Largest |u| or |v| of those, at least one.
    pub(super) widest: f64,
    /// Largest depth of a view-sample, with room for rounding, scene units.
    pub(super) far: f64,
    /// Factor that covers the rounding of a depth inside the window.
    depth_room: f64,
    /// Factor that covers it in border texels too.
    border_room: f64,
}

/// The rows a caster touches, and what spans in them are made from.
#[derive(Clone, Copy, Debug)]
pub struct Footprint {
    /// First and last row.
    pub rows: [usize; 2],
    /// First and last column of the box.
    columns: [usize; 2],
    /// The box itself, padded: smallest and largest u, then v.
    pub bounds: [[f32; 2]; 2],
    /// Edge functions, scaled to a size of one; none where the box is as good.
    lines: Option<[[f64; 3]; 3]>,
}

/// Where the view-samples of face `index` are, as far as the faces alone tell: where another face looks along each end of both
/// axes, as in a cube, none lies further than 45 degrees out.
pub fn reach_among(faces: &[Face], index: usize) -> Option<[[f32; 2]; 2]> {
    let looks = |along| faces.iter().any(|face| face.axis_z == along);
    let closed = |axis| looks(axis) && looks(-axis);
    let face = &faces[index];
    (closed(face.axis_x) && closed(face.axis_y)).then_some([[-1.00001, 1.00001]; 2])
}

impl Grid {
    /// `side` x `side` texels over the window of `face`. `reach` is where view-samples are, if known: smallest and largest u,
    /// then v.
    pub fn new(face: &Face, side: usize, reach: Option<[[f32; 2]; 2]>) -> Self {
        let count = side as f64;
        let low = face.window_low.map(f64::from);
        let texel = face.window_size.map(|size| f64::from(size) / count);
        let reach = reach.map_or([[-WILD, WILD]; 2], |range| range.map(|ends| ends.map(f64::from)));
        let [u, v] = reach.map(|[low, high]| low.abs().max(high.abs()));
        let spread = 1.0 + u * u + v * v;
        let reach = reach.map(|[low, high]| [low - SLACK * spread, high + SLACK * spread]);
        let widest = reach.iter().flatten().fold(1.0, |widest: f64, end| widest.max(end.abs()));
        let border_room = 1.0 + DEPTH_ERROR * spread.sqrt();
        let [u, v] = [0, 1].map(|axis| low[axis].abs().max((low[axis] + count * texel[axis]).abs()));
        let depth_room = 1.0 + 2.0 * DEPTH_ERROR * (1.0 + u * u + v * v).sqrt();
        let far = f64::from(face.far) * border_room;
        Self { side, low, texel, pad: 1e-3 + 3e-7 * count, reach, widest, far, depth_room, border_room }
    }

    /// Whether a caster with smallest depth `near` is behind every view-sample of the cell at `column` and `row`, whose largest
    /// depth is `list_far`.
    #[inline(always)]
    pub fn is_behind(&self, near: f64, list_far: f32, [column, row]: [usize; 2]) -> bool {
        let inner = 1..self.side - 1;
        let room = if inner.contains(&column) && inner.contains(&row) { self.depth_room } else { self.border_room };
        near > f64::from(list_far) * room
    }

    /// Whether a triangle with these corners in light space is wholly beside all view-samples: a cheap first look.
    #[inline(always)]
    pub fn is_beside(&self, corners: &[[f64; 3]; 3]) -> bool {
        let sizes = corners.map(|corner| SLACK * size(corner));
        (0..4).any(|plane| (0..3).all(|k| self.inside(plane, &corners[k]) < -sizes[k] * self.widest))
    }

    /// How far inside side plane `plane` (smallest u, largest u, smallest v, largest v) a direction is; negative outside.
    #[inline(always)]
    fn inside(&self, plane: usize, direction: &[f64; 3]) -> f64 {
        let (axis, end) = (plane / 2, plane % 2);
        let beyond = direction[axis] - self.reach[axis][end] * direction[2];
        if end == 0 { beyond } else { -beyond }
    }

    /// Smallest and largest u, then v, of the part of a triangle inside all side planes: none when there is no such part, and
    /// everything when it comes too near the light to tell.
    fn clipped(&self, corners: &[[f64; 3]; 3]) -> Option<[[f64; 2]; 2]> {
        // Each plane adds a corner at most.
        let mut polygon = [[0.0; 3]; 7];
        polygon[..3].copy_from_slice(corners);
        let mut count = 3;
        for plane in 0..4 {
            let mut next = [[0.0; 3]; 7];
            let mut kept = 0;
            for k in 0..count {
                let (a, b) = (polygon[k], polygon[(k + 1) % count]);
                let (inside_a, inside_b) = (self.inside(plane, &a), self.inside(plane, &b));
                if inside_a >= 0.0 {
                    next[kept] = a;
                    kept += 1;
                }
                if (inside_a < 0.0) != (inside_b < 0.0) {
                    let t = inside_a / (inside_a - inside_b);
                    next[kept] = [0, 1, 2].map(|axis| a[axis] + t * (b[axis] - a[axis]));
                    kept += 1;
                }
            }
            (polygon, count) = (next, kept);
        }
        let far = corners.iter().map(|corner| size(*corner)).fold(0.0, f64::max);
        let mut ends = [[f64::MAX, f64::MIN]; 2];
        for corner in &polygon[..count] {
            // Rounding of a corner that nearly cancelled; its direction is lost.
            if size(*corner) < 1e-7 * far || corner[2] <= 0.0 {
                return Some([[f64::MIN, f64::MAX]; 2]);
            }
            for axis in 0..2 {
                let at = corner[axis] / corner[2];
                ends[axis] = [ends[axis][0].min(at), ends[axis][1].max(at)];
            }
        }
        (count > 0).then_some(ends)
    }

    /// First and last texel along `axis` that the padded range meets; none when no view-sample is there.
    #[inline(always)]
    pub(super) fn range(&self, axis: usize, [low, high]: [f64; 2]) -> Option<[usize; 2]> {
        if high < self.reach[axis][0] || low > self.reach[axis][1] {
            return None;
        }
        let place = |x: f64| (x - self.low[axis]) / self.texel[axis];
        // A cast from float saturates, so both ends land inside.
        let first = (place(low) - self.pad) as usize;
        let last = (place(high) + self.pad) as usize;
        Some([first.min(self.side - 1), last.min(self.side - 1)])
    }

    /// The smallest padded range along `axis` that holds texel `index` and all that was clamped into it.
    #[inline(always)]
    pub(super) fn extent(&self, axis: usize, index: usize) -> [f64; 2] {
        let border = |at: f64| self.low[axis] + at * self.texel[axis];
        let mut ends = [border(index as f64 - self.pad), border(index as f64 + 1.0 + self.pad)];
        if index == 0 {
            ends[0] = ends[0].min(self.reach[axis][0]);
        }
        if index == self.side - 1 {
            ends[1] = ends[1].max(self.reach[axis][1]);
        }
        ends
    }
}

impl Footprint {
    /// The whole face.
    pub fn everything(grid: &Grid) -> Self {
        let all = [0, grid.side - 1];
        Self { rows: all, columns: all, bounds: [[f32::MIN, f32::MAX]; 2], lines: None }
    }

    /// That of `cone`; none when it can matter to no view-sample of the face.
    #[inline(always)]
    pub fn new(cone: &Cone, grid: &Grid) -> Option<Self> {
        let [near, _] = cone.depths();
        if near > grid.far {
            return None;
        }
        let ends = match projected(&cone.corners) {
            Some(ends) => ends,
            None => grid.clipped(&cone.corners)?,
        };
        let [u, v] = ends.map(|[low, high]| low.abs().max(high.abs()));
        let slack = SLACK * (1.0 + u * u + v * v);
        let ends = ends.map(|[low, high]| [low - slack, high + slack]);
        let columns = grid.range(0, ends[0])?;
        let rows = grid.range(1, ends[1])?;
        let bounds = ends.map(|ends| ends.map(|x| x as f32));
        let small = rows[1] - rows[0] < 2 || columns[1] - columns[0] < 2;
        Some(Self { rows, columns, bounds, lines: (!small).then(|| lines(cone)) })
    }

    /// First and last column touched in `row`, which is one of [`Footprint::rows`].
    #[inline(always)]
    pub fn span(&self, grid: &Grid, row: usize) -> Option<[usize; 2]> {
        let Some(lines) = &self.lines else {
            return Some(self.columns);
        };
        let v = grid.extent(1, row);
        let largest = grid.reach[0][0].abs().max(grid.reach[0][1].abs());
        let mut ends = [f64::MIN, f64::MAX];
        for [x, y, one] in lines {
            let at = |v: f64| y * v + SLACK * v.abs();
            let rest = one + SLACK + at(v[0]).max(at(v[1]));
            // x u + SLACK |u| + rest >= 0: a half-line, whose end is left or right of zero as `rest` says.
            if *x > 4.0 * SLACK {
                ends[0] = ends[0].max(if rest < 0.0 { -rest / (x + SLACK) } else { -rest / (x - SLACK) });
            } else if *x < -4.0 * SLACK {
                ends[1] = ends[1].min(if rest < 0.0 { rest / (SLACK - x) } else { rest / (-x - SLACK) });
            } else if rest + 5.0 * SLACK * largest < 0.0 {
                return None;
            }
        }
        if ends[0] > ends[1] {
            return None;
        }
        let [first, last] = grid.range(0, ends)?;
        let span = [first.max(self.columns[0]), last.min(self.columns[1])];
        (span[0] <= span[1]).then_some(span)
    }
}

/// Smallest and largest u, then v, of the corners; none when one is beside or behind the face, where its own direction says
/// little.
#[inline(always)]
fn projected(corners: &[[f64; 3]; 3]) -> Option<[[f64; 2]; 2]> {
    let mut ends = [[f64::MAX, f64::MIN]; 2];
    for corner in corners {
        if corner[2] <= 1e-3 * (corner[0].abs() + corner[1].abs()) {
            return None;
        }
        let reciprocal = 1.0 / corner[2];
        for axis in 0..2 {
            let at = corner[axis] * reciprocal;
            ends[axis] = [ends[axis][0].min(at), ends[axis][1].max(at)];
        }
    }
    Some(ends)
}

/// Edge functions scaled to a size of one, so that slack is absolute. A zero function bounds nothing.
#[inline(always)]
fn lines(cone: &Cone) -> [[f64; 3]; 3] {
    let mut lines = cone.edges;
    for (line, error) in lines.iter_mut().zip(cone.edge_error) {
        let length = size(*line);
        // Where rounding rivals the function itself it bounds nothing either.
        let scale = if length > 1e8 * error && length > 1e-290 { 1.0 / length } else { 0.0 };
        *line = line.map(|x| x * scale);
    }
    lines
}

#[cfg(test)]
#[path = "footprint_tests.rs"]
mod tests;
