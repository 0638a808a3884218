//! Random scenes that hard visibility must answer exactly, for the tests of the passes that do.

use super::light_frame::{self, Face};
use super::predicate::{self, Corners};
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_CELL, NO_TRIANGLE};
use std::collections::HashSet;

/// Random numbers (splitmix64).
pub struct Random(pub u64);

impl Random {
    /// The next word.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// 0, 1, .. count - 1.
    pub fn below(&mut self, count: usize) -> usize {
        (self.word() % count as u64) as usize
    }
    /// In [-1, 1).
    pub fn signed(&mut self) -> f32 {
        (self.word() >> 40) as f32 / (1 << 23) as f32 - 1.0
    }
    /// In the cube [-1, 1)^3.
    pub fn point(&mut self) -> [f32; 3] {
        [self.signed(), self.signed(), self.signed()]
    }
}

/// Inputs of one frame from the view-samples on.
pub struct Case {
    /// Casters.
    pub triangles: Vec<Corners>,
    /// Light sample.
    pub light: [f32; 3],
    /// View-samples.
    pub position: Vec<[f32; 3]>,
    /// Their triangles.
    pub triangle: Vec<u32>,
    /// Their states.
    pub state: Vec<u32>,
    /// Which triangles cast.
    pub casts: Vec<u32>,
    /// Light frame.
    pub faces: Vec<Face>,
    /// Texels a side.
    pub side: usize,
}

/// Light tables of a case by port name.
pub type Inputs = Vec<(&'static str, Array)>;

/// A scene for `seed`: kind, scale, offset, number of faces and texels all follow from it.
pub fn random(seed: u64, triangle_count: usize, sample_count: usize) -> Case {
    let mut random = Random(seed);
    let r = &mut random;
    let scale = [1.0, 1e-3, 1e4, 37.5][r.below(4)];
    let offset = if r.below(3) == 0 { [1e4, -3e3, 2e3] } else { [0.0; 3] };
    let six = r.below(3) == 0;
    let snapped = r.below(3) == 0;
    let place = |p: [f32; 3]| {
        let p = if snapped { p.map(|x| (x * 4.0).round() / 4.0) } else { p };
        [0, 1, 2].map(|axis| p[axis] * scale + offset[axis])
    };
    let light_unit = if six {
        r.point().map(|x| 0.5 * x)
    } else {
        let [x, _, z] = r.point();
        [x, [1.5, 3.0, 20.0][r.below(3)], z]
    };
    let light = place(light_unit);
    let mut triangles: Vec<Corners> = Vec::new();
    for _ in 0..triangle_count {
        let a = r.point();
        let size = [0.05, 0.3, 1.0, 2.5][r.below(4)];
        let near = |r: &mut Random, size: f32| {
            let step = r.point();
            [0, 1, 2].map(|axis| a[axis] + size * step[axis])
        };
        let (b, c) = (near(r, size), near(r, size));
        let along = |t: f32| [0, 1, 2].map(|axis| a[axis] + t * (light_unit[axis] - a[axis]));
        let corners = match r.below(10) {
            0 => [a, b, near(r, 1e-5)],
            1 => [a, b, a],
            2 => [a, b, along(0.5)],
            3 => [a, b, along(1.7)],
            4 => [a, along(0.3), along(0.31)],
            5 if !triangles.is_empty() => {
                let other = triangles[r.below(triangles.len())];
                triangles.push([other[1], other[0], other[2]]);
                continue;
            }
            6 if !triangles.is_empty() => {
                // Shares an edge.
                let other = triangles[r.below(triangles.len())];
                triangles.push([other[0], other[2], place(b)]);
                continue;
            }
            7 => [a, b, c].map(|[x, _, z]| [x, -1.0, z]),
            _ => [a, b, c],
        };
        triangles.push(corners.map(place));
    }
    let mut case = Case {
        casts: triangles.iter().map(|_| u32::from(r.below(20) > 0)).collect(),
        triangles,
        light,
        position: Vec::new(),
        triangle: Vec::new(),
        state: Vec::new(),
        faces: Vec::new(),
        side: [1, 2, 5, 16, 64][r.below(5)],
    };
    for _ in 0..sample_count {
        let own = r.below(case.triangles.len());
        let [a, b, c] = case.triangles[own];
        let (mut s, mut t) = (0.5 + 0.5 * r.signed(), 0.5 + 0.5 * r.signed());
        match r.below(8) {
            0 => t = 0.0,
            1 => t = 1.0 - s,
            2 => (s, t) = (0.0, 0.0),
            _ if s + t > 1.0 => (s, t) = (1.0 - s, 1.0 - t),
            _ => {}
        }
        case.position.push([0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k])));
        case.triangle.push(own as u32);
        case.state.push(match r.below(30) {
            0 => BACKGROUND,
            1 => FACING_AWAY,
            _ => KEPT,
        });
    }
    for (state, triangle) in case.state.iter().zip(&mut case.triangle) {
        if *state == BACKGROUND {
            *triangle = NO_TRIANGLE;
        }
    }
    let tight = r.below(3) == 0;
    case.look(six, tight);
    case
}

impl Case {
    /// Makes the light frame: a cube, or one face towards the middle; `tight` leaves view-samples outside the window.
    pub fn look(&mut self, six: bool, tight: bool) {
        let origin = Vec3::from(self.light);
        let face = |x: Vec3, y: Vec3, z: Vec3| Face {
            origin,
            valid: true,
            axis_x: x,
            axis_y: y,
            axis_z: z,
            window_low: [-1.0; 2],
            window_size: [2.0; 2],
            near: 0.0,
            far: 0.0,
        };
        if six {
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            let sided = |k: usize, s: f32| face(axes[(k + 1) % 3], axes[(k + 2) % 3] * s, axes[k] * s);
            self.faces = (0..3).flat_map(|k| [sided(k, 1.0), sided(k, -1.0)]).collect();
        } else {
            let middle = self.position.iter().map(|p| Vec3::from(*p)).sum::<Vec3>() / self.position.len().max(1) as f32;
            let z = (middle - origin).try_normalize().unwrap_or(Vec3::NEG_Y);
            let x = z.any_orthonormal_vector();
            self.faces = vec![face(x, z.cross(x), z)];
        }
        let mut ends = [[f32::MAX, f32::MIN]; 2];
        for (position, state) in self.position.iter().zip(&mut self.state) {
            if *state != KEPT {
                continue;
            }
            let Some(point) = light_frame::project(&self.faces, Vec3::from(*position)) else {
                *state = BACKGROUND;
                continue;
            };
            let face = &mut self.faces[point.face];
            face.far = face.far.max(point.depth);
            for (ends, at) in ends.iter_mut().zip([point.u, point.v]) {
                *ends = [ends[0].min(at), ends[1].max(at)];
            }
        }
        if !six && ends[0][0] <= ends[0][1] {
            for (axis, [low, high]) in ends.into_iter().enumerate() {
                let inset = if tight { 0.3 * (high - low) } else { 0.0 };
                self.faces[0].window_low[axis] = low + inset;
                self.faces[0].window_size[axis] = (high - low - 2.0 * inset).max(1e-6);
            }
        }
        for (state, triangle) in self.state.iter().zip(&mut self.triangle) {
            if *state == BACKGROUND {
                *triangle = NO_TRIANGLE;
            }
        }
    }

    /// Every input of binning and visibility but the caster table.
    pub fn inputs(&self) -> Inputs {
        let (count, side, samples) = (self.faces.len(), self.side, self.position.len());
        let cells = count * side * side;
        let mut cell = vec![NO_CELL; samples];
        let mut lists = vec![Vec::new(); cells];
        let mut far = vec![0.0f32; cells];
        for (index, position) in self.position.iter().enumerate() {
            if self.state[index] != KEPT {
                continue;
            }
            if let Some((at, depth)) = light_frame::cell_of(&self.faces, Vec3::from(*position), side) {
                cell[index] = at as u32;
                lists[at].push(index as u32);
                far[at] = far[at].max(depth);
            }
        }
        let length: Vec<u32> = lists.iter().map(|list| list.len() as u32).collect();
        let mut entries: Vec<u32> = lists.concat();
        entries.resize(samples, 0xdead_beef);
        let frame = self.faces.iter().flat_map(Face::to_words).collect();
        vec![
            ("triangles", Array::f32([self.triangles.len(), 3, 3], bytemuck::cast_slice(&self.triangles).to_vec())),
            ("caster_state", Array::u32([self.casts.len()], self.casts.clone())),
            ("light_samples", Array::f32([1, 3], self.light.to_vec())),
            ("light_frame", Array::f32([count, 20], frame)),
            ("position", Array::f32([samples, 3], bytemuck::cast_slice(&self.position).to_vec())),
            ("triangle", Array::u32([samples], self.triangle.clone())),
            ("sample_state", Array::u32([samples], self.state.clone())),
            ("cell", Array::u32([samples], cell)),
            ("list_offset", Array::u32([cells + 1], scan(&length))),
            ("list_length", Array::u32([count, side, side], length)),
            ("list_far", Array::f32([count, side, side], far)),
            ("list_entries", Array::u32([samples], entries)),
        ]
    }

    /// Whether triangle `caster` blocks view-sample `sample`.
    pub fn blocks(&self, sample: usize, caster: usize) -> bool {
        let own = self.triangle[sample];
        let own_corners = self.triangles.get(own as usize);
        own != caster as u32
            && self.casts[caster] != 0
            && predicate::blocks(self.position[sample], own_corners, &self.triangles[caster], self.light)
    }

    /// The mask by brute force.
    pub fn mask(&self) -> Vec<u32> {
        let row = |sample: usize| match self.state[sample] {
            KEPT => u32::from((0..self.triangles.len()).any(|caster| self.blocks(sample, caster))),
            FACING_AWAY => u32::MAX,
            _ => 0,
        };
        (0..self.position.len()).map(row).collect()
    }
}

/// A flat square of `side` times `side` cells, two triangles each, in that order.
pub fn grid(side: usize) -> Vec<Corners> {
    let at = |x: usize, y: usize| [x as f32, y as f32, 0.0];
    (0..side * side)
        .flat_map(|cell| {
            let (x, y) = (cell % side, cell / side);
            [[at(x, y), at(x + 1, y), at(x, y + 1)], [at(x + 1, y + 1), at(x, y + 1), at(x + 1, y)]]
        })
        .collect()
}

/// Exclusive prefix sum with the total last.
pub fn scan(length: &[u32]) -> Vec<u32> {
    let mut total = 0;
    let mut offsets = vec![0];
    offsets.extend(length.iter().map(|count| {
        total += count;
        total
    }));
    offsets
}

/// Runs a pass on arrays by port name; outputs and counts.
///
/// # Errors
/// What the pass reports.
pub fn run(pass: &'static Pass, inputs: &Inputs) -> Result<(Inputs, Vec<u64>), Problem> {
    run_with(pass, &Params::defaults(pass.params), inputs)
}

/// Runs a pass with parameters.
///
/// # Errors
/// What the pass reports.
pub fn run_with(pass: &'static Pass, params: &Params, inputs: &Inputs) -> Result<(Inputs, Vec<u64>), Problem> {
    let inputs = inputs.iter().map(|(name, array)| (*name, array)).collect();
    let mut cx = CpuCx::new(pass, params, [1, 1], inputs, &|_, _| {});
    match pass.cpu {
        Some(function) => function(&mut cx)?,
        None => unreachable!("{pass:?} has no CPU function"),
    }
    Ok(cx.finish())
}

/// Output `port` of a run.
pub fn output<'a>(outputs: &'a Inputs, port: &str) -> &'a Array {
    match outputs.iter().find(|(name, _)| *name == port) {
        Some((_, array)) => array,
        None => unreachable!("no output {port}"),
    }
}

/// (cell, caster) pairs, after a check of slots, lengths and doubles.
pub fn pairs(outputs: &Inputs) -> HashSet<(u32, u32)> {
    let [cells, slots, casters] = ["pair_cell", "pair_slot", "pair_caster"].map(|port| output(outputs, port).as_u32());
    let length = output(outputs, "caster_length").as_u32();
    assert_eq!(length.iter().sum::<u32>() as usize, cells.len());
    let places: HashSet<_> = cells.iter().zip(slots).collect();
    assert_eq!(places.len(), cells.len(), "a place is given twice");
    assert!(cells.iter().zip(slots).all(|(cell, slot)| *slot < length[*cell as usize]));
    let pairs: HashSet<_> = cells.iter().copied().zip(casters.iter().copied()).collect();
    assert_eq!(pairs.len(), cells.len(), "a pair is listed twice");
    pairs
}
