//! Random scenes with area lights, for the tests of passes whose pairs must hold everything that any light sample needs.

use super::hard_scenes::{Case, Inputs, Random, random};
use super::light_fit;
use super::predicate;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::shared::{BACKGROUND, KEPT};
use std::collections::HashSet;

/// Sets of light samples.
pub const LIGHTS: [&str; 7] = ["point", "equal", "sphere", "disc", "rectangle", "ellipsoid", "dumbbell"];

/// A scene and its light samples.
pub struct Soft {
    /// The scene; its light is the middle of the samples.
    pub case: Case,
    /// Light samples.
    pub light: Vec<[f32; 3]>,
}

/// A point of the unit ball.
fn in_ball(r: &mut Random) -> Vec3 {
    loop {
        let point = Vec3::from(r.point());
        if point.length_squared() <= 1.0 {
            return point;
        }
    }
}

/// `count` samples of the light `kind`, extents about one.
fn samples(kind: &str, count: usize, r: &mut Random) -> Vec<Vec3> {
    let turn = glam::Quat::from_axis_angle(in_ball(r).try_normalize().unwrap_or(Vec3::X), 3.0 * r.signed());
    let one = |r: &mut Random| match kind {
        "sphere" => in_ball(r),
        "disc" => {
            let [x, y, _] = in_ball(r).to_array();
            Vec3::new(x, y, 0.0)
        }
        "rectangle" => Vec3::new(r.signed(), 0.3 * r.signed(), 0.0),
        "ellipsoid" => in_ball(r) * Vec3::new(0.25, 1.0, 0.05),
        "dumbbell" => 0.3 * in_ball(r) + if r.below(2) == 0 { Vec3::X } else { -Vec3::X },
        _ => Vec3::ZERO,
    };
    (0..if kind == "point" { 1 } else { count }).map(|_| turn * one(r)).collect()
}

/// A scene for `seed` under a light of kind `kind`: its size, from a thousandth of the distance to the scene to a little more than
/// that, follows from the seed.
pub fn soft(seed: u64, kind: &str, triangle_count: usize, sample_count: usize) -> Soft {
    let mut case = random(seed, triangle_count, sample_count);
    let mut r = Random(seed ^ 0x5eed);
    let six = case.faces.len() == 6;
    let centre = Vec3::from(case.light);
    let kept = || case.position.iter().map(|position| (Vec3::from(*position) - centre).length());
    let distance = kept().sum::<f32>() / case.position.len().max(1) as f32;
    let extent = distance * [1e-3, 0.03, 0.2, 0.6, 1.2][r.below(5)];
    let light: Vec<[f32; 3]> =
        samples(kind, 24, &mut r).into_iter().map(|sample| (centre + extent * sample).to_array()).collect();
    // As the light frame does.
    case.light = light_fit::origin(&light).to_array();
    for (state, position) in case.state.iter_mut().zip(&case.position) {
        if *state == BACKGROUND && position.iter().all(|x| x.is_finite()) {
            *state = KEPT;
        }
    }
    case.look(six, r.below(3) == 0);
    Soft { case, light }
}

impl Soft {
    /// Every input of binning and visibility but the caster table.
    pub fn inputs(&self) -> Inputs {
        self.inputs_lit_by(&self.light)
    }

    /// The same with other light samples.
    pub fn inputs_lit_by(&self, light: &[[f32; 3]]) -> Inputs {
        let mut inputs = self.case.inputs();
        for (name, array) in &mut inputs {
            if *name == "light_samples" {
                *array = Array::f32([light.len(), 3], bytemuck::cast_slice(light).to_vec());
            }
        }
        inputs
    }

    /// (cell, caster) pairs in which the caster blocks some light sample from some view-sample of the cell, whose cells are `cell`.
    pub fn needed(&self, cell: &[u32]) -> HashSet<(u32, u32)> {
        let case = &self.case;
        let mut needed = HashSet::new();
        for sample in (0..cell.len()).filter(|sample| cell[*sample] != u32::MAX) {
            let own = case.triangle[sample];
            let own_corners = case.triangles.get(own as usize);
            for caster in (0..case.triangles.len() as u32).filter(|caster| *caster != own) {
                let corners = &case.triangles[caster as usize];
                let blocks = |light: &[f32; 3]| predicate::blocks(case.position[sample], own_corners, corners, *light);
                let pair = (cell[sample], caster);
                if case.casts[caster as usize] != 0 && !needed.contains(&pair) && self.light.iter().any(blocks) {
                    needed.insert(pair);
                }
            }
        }
        needed
    }
}
