//! Points inside closed meshes, uniform by volume: points of the bounding box, without those outside.
//!
//! Inside is where the winding number is not zero: the crossings of a ray along +x, counted by direction. Triangles are listed by
//! the cells of a grid across the ray that their shadow along x touches, so that a point asks a few triangles only. Edges are
//! evaluated from the same end for both triangles at them, and ties go one way, so that no ray slips through a seam.

use super::generator::Sequence;
use glam::{DVec2, DVec3, Vec3, dvec2};
use shadowgraph_core::problem::{Kind, Problem};

/// Most points of the bounding box that are tried.
const MOST_TRIED: usize = 1 << 21;
/// Most list entries for each triangle: the grid is made coarser until they suffice.
const ENTRIES_PER_TRIANGLE: usize = 16;

/// Closed triangles and the grid across x.
pub struct Volume {
    corners: Vec<[DVec3; 3]>,
    low: DVec3,
    high: DVec3,
    side: usize,
    offset: Vec<u32>,
    entries: Vec<u32>,
}

impl Volume {
    /// Triangles must be closed parts that face outwards; see [`super::volume_light`].
    pub fn new(triangles: &[[[f32; 3]; 3]]) -> Self {
        let wide = |corner: [f32; 3]| Vec3::from(corner).as_dvec3();
        let corners: Vec<[DVec3; 3]> = triangles.iter().map(|corners| corners.map(wide)).collect();
        let all = || corners.iter().flatten();
        let low = all().fold(DVec3::INFINITY, |low, corner| low.min(*corner));
        let high = all().fold(DVec3::NEG_INFINITY, |high, corner| high.max(*corner));
        let mut volume = Self { corners, low, high, side: 1, offset: Vec::new(), entries: Vec::new() };
        let most = ENTRIES_PER_TRIANGLE * volume.corners.len();
        volume.side = ((volume.corners.len() as f64).sqrt() as usize).clamp(1, 1024);
        while volume.side > 1 && volume.lengths().iter().map(|length| *length as usize).sum::<usize>() > most {
            volume.side /= 2;
        }
        volume.list();
        volume
    }

    /// Volume, cubic scene units; parts that overlap count twice.
    pub fn volume(&self) -> f64 {
        self.corners.iter().map(|corners| self.signed_volume(corners)).sum()
    }

    /// The mean of all points, overlaps counted twice.
    pub fn centroid(&self) -> DVec3 {
        let weighted = |corners: &[DVec3; 3]| {
            let sum = corners.iter().map(|corner| *corner - self.low).sum::<DVec3>();
            self.signed_volume(corners) * sum / 4.0
        };
        self.low + self.corners.iter().map(weighted).sum::<DVec3>() / self.volume()
    }

    /// `count` points inside.
    ///
    /// # Errors
    /// The volume fills too little of its bounding box.
    pub fn points(&self, sequence: Sequence, count: usize) -> Result<Vec<DVec3>, Problem> {
        let extent = self.high - self.low;
        let share = (self.volume() / (extent.x * extent.y * extent.z)).min(1.0);
        let mut tried = (count as f64 / share).ceil();
        for _ in 0..8 {
            if tried.is_nan() || tried > MOST_TRIED as f64 {
                break;
            }
            let cube = sequence.cube(tried as usize);
            let mut inside: Vec<DVec3> = cube.into_iter().map(|p| self.low + DVec3::from(p) * extent).collect();
            inside.retain(|point| self.holds(*point));
            if inside.len() >= count {
                // The few too many leave from everywhere alike.
                let kept = inside.len();
                return Ok((0..count).map(|index| inside[(2 * index + 1) * kept / (2 * count)]).collect());
            }
            tried = (tried * count as f64 / inside.len().max(1) as f64 + 1.0).ceil();
        }
        Err(Problem::new(Kind::BadGeometry, "the light's volume fills too little of its bounding box")
            .expected(format!("at least 1 in {} parts for {count} light samples", MOST_TRIED / count))
            .found(format!("{share:.1e} of the box"))
            .remedy("use fewer light samples, or the mesh's surface"))
    }

    /// Whether the winding number around `point` is not zero.
    pub fn holds(&self, point: DVec3) -> bool {
        let across = dvec2(point.y, point.z);
        let cell = self.cell(across);
        let at = cell[0] * self.side + cell[1];
        let listed = &self.entries[self.offset[at] as usize..self.offset[at + 1] as usize];
        listed.iter().map(|triangle| crossing(&self.corners[*triangle as usize], point)).sum::<i32>() != 0
    }

    fn signed_volume(&self, corners: &[DVec3; 3]) -> f64 {
        let [a, b, c] = corners.map(|corner| corner - self.low);
        a.dot(b.cross(c)) / 6.0
    }

    fn cell(&self, across: DVec2) -> [usize; 2] {
        let low = dvec2(self.low.y, self.low.z);
        let extent = dvec2(self.high.y, self.high.z) - low;
        let last = self.side as f64 - 1.0;
        // A flat box gives 0/0, which the conversion takes for 0.
        let at = ((across - low) / extent * self.side as f64).to_array();
        at.map(|x| x.clamp(0.0, last) as usize)
    }

    fn cells(&self, corners: &[DVec3; 3]) -> [[usize; 2]; 2] {
        let across = corners.map(|corner| dvec2(corner.y, corner.z));
        let low = self.cell(across[0].min(across[1]).min(across[2]));
        let high = self.cell(across[0].max(across[1]).max(across[2]));
        [low, high]
    }

    fn lengths(&self) -> Vec<u32> {
        let mut lengths = vec![0; self.side * self.side];
        for corners in &self.corners {
            let [low, high] = self.cells(corners);
            for row in low[0]..=high[0] {
                lengths[row * self.side + low[1]..=row * self.side + high[1]]
                    .iter_mut()
                    .for_each(|length| *length += 1);
            }
        }
        lengths
    }

    fn list(&mut self) {
        let mut total = 0;
        self.offset = vec![0];
        self.offset.extend(self.lengths().iter().map(|length| {
            total += length;
            total
        }));
        let mut next = self.offset.clone();
        self.entries = vec![0; total as usize];
        for (index, corners) in self.corners.iter().enumerate() {
            let [low, high] = self.cells(corners);
            for cell in (low[0]..=high[0]).flat_map(|row| (low[1]..=high[1]).map(move |column| [row, column])) {
                let slot = &mut next[cell[0] * self.side + cell[1]];
                self.entries[*slot as usize] = index as u32;
                *slot += 1;
            }
        }
    }
}

/// 1 or -1 where the ray from `point` along +x passes the triangle, by the side it comes from; else 0.
fn crossing(corners: &[DVec3; 3], point: DVec3) -> i32 {
    let across = dvec2(point.y, point.z);
    let flat = corners.map(|corner| dvec2(corner.y, corner.z));
    // Winding of the projected triangle around the point, edge by edge (Sunday 2001): half-open in the second coordinate.
    let winding = edge(flat[0], flat[1], across) + edge(flat[1], flat[2], across) + edge(flat[2], flat[0], across);
    if winding == 0 {
        return 0;
    }
    let [a, b, c] = corners;
    let normal = (*b - *a).cross(*c - *a);
    // The triangle's plane at the point's line: in front of it or behind?
    let is_ahead = normal.dot(*a - point) * normal.x > 0.0;
    if is_ahead { winding } else { 0 }
}

/// 1 where the edge passes the ray from `point` along the first coordinate upwards, -1 downwards.
fn edge(from: DVec2, to: DVec2, point: DVec2) -> i32 {
    let is_up = from.y <= point.y && point.y < to.y;
    let is_down = to.y <= point.y && point.y < from.y;
    if !(is_up || is_down) {
        return 0;
    }
    let (low, high) = if is_up { (from, to) } else { (to, from) };
    // Evaluated from the lower end whichever way the triangle runs along the edge: its two triangles agree.
    let is_right = (high - low).perp_dot(point - low) > 0.0;
    if is_right { if is_up { 1 } else { -1 } } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin;

    fn knot() -> Vec<[[f32; 3]; 3]> {
        let scene = builtin::build("torus-knot").unwrap();
        let closed = |row: &usize| scene.flags[*row] & shadowgraph_core::scene::flag::CLOSED != 0;
        (0..scene.triangle_count()).filter(closed).map(|row| scene.positions[row]).collect()
    }

    /// The judge: the sum of solid angles.
    fn winding(triangles: &[[[f32; 3]; 3]], point: DVec3) -> f64 {
        let angle = |corners: &[[f32; 3]; 3]| {
            let [a, b, c] = corners.map(|corner| Vec3::from(corner).as_dvec3() - point);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(below)
        };
        triangles.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }

    #[test]
    fn inside_is_what_the_solid_angles_say() {
        let triangles = knot();
        let volume = Volume::new(&triangles);
        let extent = volume.high - volume.low;
        let sequence = Sequence { generator: super::super::Generator::Random, seed: 5, stream: 0 };
        let mut inside = 0;
        for point in sequence.cube(2000) {
            let point = volume.low + DVec3::from(point) * extent;
            let expected = winding(&triangles, point).abs() > 0.5;
            assert_eq!(volume.holds(point), expected, "{point}");
            inside += u32::from(expected);
        }
        let share = volume.volume() / (extent.x * extent.y * extent.z);
        assert!((f64::from(inside) / 2000.0 - share).abs() < 0.03, "{inside} {share}");
    }

    #[test]
    fn rays_through_vertices_and_edges_do_not_slip() {
        // An octahedron: rays along x from its middle meet a vertex, others its edges.
        let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let less = |v: [f32; 3]| v.map(|x| -x);
        let mut triangles = Vec::new();
        for (sx, sy, sz) in (0..8).map(|bits| (bits & 1, bits & 2, bits & 4)) {
            let pick = |v, s| if s == 0 { v } else { less(v) };
            let corners = [pick(x, sx), pick(y, sy), pick(z, sz)];
            let is_odd = (usize::from(sx > 0) + usize::from(sy > 0) + usize::from(sz > 0)) % 2 == 1;
            triangles.push(if is_odd { [corners[0], corners[2], corners[1]] } else { corners });
        }
        let volume = Volume::new(&triangles);
        assert!((volume.volume() - 4.0 / 3.0).abs() < 1e-12);
        assert!(volume.centroid().length() < 1e-12);
        for p in [[0.0, 0.0, 0.0], [-0.5, 0.0, 0.25], [0.0, 0.5, 0.0], [0.25, 0.25, 0.25], [-0.9, 0.0, 0.0]] {
            assert!(volume.holds(DVec3::from(p)), "{p:?}");
        }
        for p in [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [-0.9, 0.5, 0.0], [-0.5, 0.5, 0.25], [-2.0, 1.0, 0.0]] {
            assert!(!volume.holds(DVec3::from(p)), "{p:?}");
        }
    }
}
