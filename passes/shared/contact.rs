//! The contact band: view-samples whose answer a step of a few units in the last place could turn.
//!
//! The exact predicate ([`crate::shared::predicate`]) answers for the stored bits of a view-sample. Those bits are themselves
//! a rounded surface point, so where the point lies within a few of its own rounding steps of a plane that decides, any answer
//! is as good as another. Here each plane answers yes, no or close, and the three are combined as in Kleene's logic: a
//! view-sample is in the band when no caster blocks it for certain and some caster may.

use crate::shared::bvh::{Bvh, Walk};
use crate::shared::predicate::Corners;
use glam::DVec3;

/// What a caster does at a view-sample when planes closer than a step are left undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It does not block, by more than a step.
    Clear,
    /// A plane that decides is within a step.
    Close,
    /// It blocks, by more than a step.
    Blocks,
}

/// The step: `ulps` units in the last place of the largest coordinate among `points`, world units along each axis.
pub fn step<'a>(ulps: f32, points: impl IntoIterator<Item = &'a [f32; 3]>) -> f64 {
    let largest = points.into_iter().flatten().fold(0.0f32, |largest, x| largest.max(x.abs()));
    f64::from(ulps) * f64::from(largest) * f64::from(f32::EPSILON)
}

/// A plane through `point`, not normalised, in f64: rounding is some 2^-29 of an f32 step.
struct Plane {
    point: DVec3,
    normal: DVec3,
    /// Change of [`Plane::height`] for a step along every axis.
    slack: f64,
}

impl Plane {
    fn new(a: DVec3, b: DVec3, c: DVec3, step: f64) -> Self {
        let normal = (b - a).cross(c - b);
        Self { point: a, normal, slack: step * (normal.x.abs() + normal.y.abs() + normal.z.abs()) }
    }
    fn height(&self, at: DVec3) -> f64 {
        self.normal.dot(at - self.point)
    }
    /// Whether `at` is above (side 1) or below (side -1) the plane: (certainly, possibly).
    fn is_above(&self, at: DVec3, side: f64) -> [bool; 2] {
        let height = self.height(at) * side;
        [height > self.slack, height >= -self.slack]
    }
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

/// What `caster` does at `position`, which lies on `own` or on none, as `light` sees it. Planes nearer to a point than `step`
/// along every axis are left undecided; a corner that `own` shares with `caster` is in its plane for certain.
pub fn verdict(position: [f32; 3], own: Option<&Corners>, caster: &Corners, light: [f32; 3], step: f64) -> Verdict {
    let [a, b, c] = caster.map(wide);
    let (at, from) = (wide(position), wide(light));
    let support = Plane::new(a, b, c, step);
    if support.normal == DVec3::ZERO {
        return Verdict::Clear;
    }
    let pyramid = [Plane::new(from, a, b, step), Plane::new(from, b, c, step), Plane::new(from, c, a, step)];
    let own = own.map(|own| (own, Plane::new(wide(own[0]), wide(own[1]), wide(own[2]), step)));
    let mut verdict = Verdict::Clear;
    for side in [1.0, -1.0] {
        // Inside the pyramid, a point is on the same side of all its planes as of the supporting plane.
        let mut all = [true; 2];
        let mut need = |answer: [bool; 2]| all = [all[0] && answer[0], all[1] && answer[1]];
        need(support.is_above(at, side));
        need(support.is_above(from, -side));
        for plane in &pyramid {
            need(plane.is_above(at, side));
        }
        if let Some((own, plane)) = &own {
            let toward = if plane.height(from) < 0.0 { -1.0 } else { 1.0 };
            let side_known = plane.height(from).abs() > plane.slack;
            let mut any = [false, !side_known];
            for corner in caster.iter().filter(|corner| !own.contains(corner)) {
                let [certainly, possibly] = plane.is_above(wide(*corner), toward);
                any = [any[0] || (certainly && side_known), any[1] || possibly];
            }
            need(any);
        }
        match all {
            [true, _] => return Verdict::Blocks,
            [false, true] => verdict = Verdict::Close,
            [false, false] => {}
        }
    }
    verdict
}

/// For each of `rows`, whether that view-sample is in the contact band of `ulps` for any light sample. `caster_state` as
/// its port: triangles not 1 do not cast.
pub fn contact_band(
    triangles: &[Corners],
    caster_state: &[u32],
    light_samples: &[[f32; 3]],
    position: &[[f32; 3]],
    own_triangle: &[u32],
    rows: &[usize],
    ulps: f32,
) -> Vec<bool> {
    if rows.is_empty() || ulps <= 0.0 {
        return vec![false; rows.len()];
    }
    let bvh = Bvh::build(triangles, |id| caster_state[id] == 1);
    let mut walk = Walk::default();
    rows.iter()
        .map(|&row| {
            let own = own_triangle[row];
            light_samples.iter().any(|&light| {
                let (mut firm, mut close) = (false, false);
                // No caster's own step, found below, is longer.
                let pad = step(ulps, bvh.extremes().iter().chain([&position[row], &light]));
                bvh.along_segment(&mut walk, position[row], light, pad, |id| {
                    if id != own {
                        let caster = &triangles[id as usize];
                        let step = step(ulps, caster.iter().chain([&position[row], &light]));
                        match verdict(position[row], triangles.get(own as usize), caster, light, step) {
                            Verdict::Blocks => firm = true,
                            Verdict::Close => close = true,
                            Verdict::Clear => {}
                        }
                    }
                    firm
                });
                close && !firm
            })
        })
        .collect()
}
