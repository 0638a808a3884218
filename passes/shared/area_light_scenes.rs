//! Random scenes with area lights that soft visibility must answer exactly, for the tests of the passes that do.

use super::hard_scenes::{Case, Inputs, Random, output, random, scan};
use super::predicate::blocks;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::shared::KEPT;

/// A frame with an area light.
pub struct SoftCase {
    /// All but the light samples.
    pub case: Case,
    /// Light samples, world space.
    pub samples: Vec<[f32; 3]>,
}

/// A scene for `seed` with `light_sample_count` light samples: in a ball, in a plane, on corners and planes of casters, or among them.
pub fn soft(seed: u64, triangle_count: usize, view_sample_count: usize, light_sample_count: usize) -> SoftCase {
    let case = random(seed, triangle_count, view_sample_count);
    let r = &mut Random(seed ^ 0x5eed);
    let first = case.position.first().copied().unwrap_or_default();
    let far = (0..3).map(|k| (case.light[k] - first[k]).abs()).fold(0.0, f32::max);
    let spread = far * [0.3, 0.02, 1.0, 1e-4][r.below(4)];
    let flat = r.below(3) == 0;
    let samples = (0..light_sample_count)
        .map(|index| {
            let step = r.point();
            let near = [0, 1, 2].map(|k| case.light[k] + if flat && k == 1 { 0.0 } else { spread * step[k] });
            match r.below(24) {
                // A corner; the middle of an edge; a point of a caster's plane outside it.
                0 if spread > 0.1 * far => case.triangles[r.below(case.triangles.len())][r.below(3)],
                1 if spread > 0.1 * far => {
                    let [a, b, c] = case.triangles[r.below(case.triangles.len())];
                    [0, 1, 2].map(|k| if index % 2 == 0 { 0.5 * a[k] + 0.5 * b[k] } else { a[k] + b[k] - c[k] })
                }
                _ => near,
            }
        })
        .collect();
    SoftCase { case, samples }
}

/// As [`soft`], with all light samples in one plane.
pub fn soft_planar(seed: u64, triangle_count: usize, view_sample_count: usize, light_sample_count: usize) -> SoftCase {
    let case = random(seed, triangle_count, view_sample_count);
    let first = case.position.first().copied().unwrap_or_default();
    let far = (0..3).map(|k| (case.light[k] - first[k]).abs()).fold(0.0, f32::max);
    let r = &mut Random(seed);
    let sample = |_| {
        let [x, _, z] = r.point();
        [case.light[0] + 0.2 * far * x, case.light[1], case.light[2] + 0.2 * far * z]
    };
    let samples = (0..light_sample_count).map(sample).collect();
    SoftCase { case, samples }
}

/// As [`soft`], with all light samples in a disc that is tilted about two axes.
pub fn soft_tilted(seed: u64, triangle_count: usize, view_sample_count: usize, light_sample_count: usize) -> SoftCase {
    let case = random(seed, triangle_count, view_sample_count);
    let first = case.position.first().copied().unwrap_or_default();
    let far = (0..3).map(|k| (case.light[k] - first[k]).abs()).fold(0.0, f32::max);
    let samples = disc(&mut Random(seed), case.light, [0.3, 1.0, 0.2], 0.2 * far, light_sample_count);
    SoftCase { case, samples }
}

/// Random points of a disc about `centre`.
pub fn disc(r: &mut Random, centre: [f32; 3], normal: [f32; 3], radius: f32, count: usize) -> Vec<[f32; 3]> {
    let (x, y) = Vec3::from(normal).normalize().any_orthonormal_pair();
    let sample = |_| {
        let turn = std::f32::consts::PI * r.signed();
        let along = radius * (0.5 + 0.5 * r.signed()).sqrt();
        (Vec3::from(centre) + along * (turn.cos() * x + turn.sin() * y)).to_array()
    };
    (0..count).map(sample).collect()
}

impl SoftCase {
    /// Whether triangle `caster` blocks light sample `sample` at `row`.
    pub fn blocks(&self, row: usize, caster: usize, sample: usize) -> bool {
        let (case, own) = (&self.case, self.case.triangle[row]);
        own != caster as u32
            && case.casts[caster] != 0
            && blocks(
                case.position[row],
                case.triangles.get(own as usize),
                &case.triangles[caster],
                self.samples[sample],
            )
    }

    /// The plain twin: every view-sample, light sample and triangle.
    pub fn mask(&self) -> Vec<u32> {
        let words = self.samples.len().div_ceil(32);
        let mut masks = vec![0; self.case.position.len() * words];
        for (row, state) in self.case.state.iter().enumerate() {
            let mask = &mut masks[row * words..(row + 1) * words];
            if *state == KEPT {
                for sample in 0..self.samples.len() {
                    let blocked = (0..self.case.triangles.len()).any(|caster| self.blocks(row, caster, sample));
                    mask[sample / 32] |= u32::from(blocked) << (sample % 32);
                }
            } else if *state == shadowgraph_core::shared::FACING_AWAY {
                mask.fill(u32::MAX);
            }
        }
        masks
    }

    /// Inputs of visibility with a caster table that lists, in every cell, all casters that block a light sample at one of its
    /// view-samples, and every `more`-th other caster.
    pub fn inputs(&self, more: usize) -> Inputs {
        let case = &self.case;
        let mut inputs = case.inputs();
        let cells = output(&inputs, "list_length").words().len();
        let cell = output(&inputs, "cell").as_u32().to_vec();
        let mut table = vec![Vec::new(); cells];
        for (at, list) in table.iter_mut().enumerate() {
            let here: Vec<usize> = (0..cell.len()).filter(|row| cell[*row] == at as u32).collect();
            for caster in (0..case.triangles.len()).filter(|caster| case.casts[*caster] != 0) {
                let matters =
                    || here.iter().any(|row| (0..self.samples.len()).any(|sample| self.blocks(*row, caster, sample)));
                if caster % more == 0 || matters() {
                    list.push(caster as u32);
                }
            }
        }
        let lengths: Vec<u32> = table.iter().map(|list| list.len() as u32).collect();
        let entries = table.concat();
        inputs.push(("caster_offset", Array::u32([cells + 1], scan(&lengths))));
        inputs.push(("caster_entries", Array::u32([entries.len()], entries)));
        for (port, array) in &mut inputs {
            if *port == "light_samples" {
                *array = Array::f32([self.samples.len(), 3], bytemuck::cast_slice(&self.samples).to_vec());
            }
        }
        inputs
    }
}

/// A table pass of stage `lu_table` with `size` bins, added to `inputs`.
///
/// # Panics
/// No such pass, or one that fails: a fault of the test.
pub fn add_table(inputs: &mut Inputs, table: &str, size: u32) {
    let catalogue = crate::catalogue();
    let pass = catalogue.pass("lu_table", table).expect("a table");
    let params = Params(vec![("size", Value::U32(size))]);
    let read = inputs.iter().map(|(name, array)| (*name, array)).collect();
    let mut cx = CpuCx::new(pass, &params, [1, 1], read, &|_, _| {});
    let function = pass.cpu.expect("has a CPU function");
    function(&mut cx).expect("makes a table");
    let (outputs, _) = cx.finish();
    inputs.extend(outputs);
}

/// Points of the unit ball, well spread.
pub fn ball(count: usize) -> Vec<[f32; 3]> {
    let r = &mut Random(1);
    let mut points: Vec<[f32; 3]> = Vec::new();
    while points.len() < count {
        // The best of ten is the farthest from all others.
        let inside = (0..30).map(|_| r.point()).filter(|p| p.iter().map(|x| x * x).sum::<f32>() <= 1.0).take(10);
        let far = |p: &[f32; 3]| {
            let apart = |q: &[f32; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f32>();
            points.iter().map(apart).fold(f32::MAX, f32::min)
        };
        points.extend(inside.max_by(|a, b| far(a).total_cmp(&far(b))));
    }
    points
}
