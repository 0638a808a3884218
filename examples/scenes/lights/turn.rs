//! Sample sets turned about the light's axis of symmetry: other samples of the same light, equally well spread (Sintorn 2008,
//! section 4.2: rotation on a per-pixel basis gives jittering).

use glam::{DQuat, DVec3, Vec3};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Light, LightShape};
use std::f64::consts::TAU;

/// Turns that map a light onto itself.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Symmetry {
    /// Unit.
    axis: DVec3,
    /// Equal turns in a circle; none: any turn.
    order: Option<u32>,
}

/// `positions` of `light`, turned by `step` of `steps` equal turns of a circle about its axis, and rounded to f32. A light that only
/// some turns map onto itself takes the nearest of those below; turn 0 changes nothing.
///
/// # Errors
/// A light without such an axis, or with a texture, which turns would move.
pub fn turned(light: &Light, positions: &[[f32; 3]], step: usize, steps: usize) -> Result<Vec<[f32; 3]>, Problem> {
    let Symmetry { axis, order } = symmetry(light)?;
    let share = match order {
        Some(order) => (step * order as usize / steps.max(1)) as f64 / f64::from(order),
        None => step as f64 / steps.max(1) as f64,
    };
    if share == 0.0 {
        return Ok(positions.to_vec());
    }
    let turn = DQuat::from_axis_angle(axis, TAU * share);
    let centre = wide(light.position);
    Ok(positions.iter().map(|point| (centre + turn * (wide(*point) - centre)).as_vec3().to_array()).collect())
}

fn wide(point: [f32; 3]) -> DVec3 {
    Vec3::from(point).as_dvec3()
}

fn symmetry(light: &Light) -> Result<Symmetry, Problem> {
    let refused = |what: &str| {
        Err(Problem::new(Kind::BadValue, format!("{what} cannot be turned: it has no axis of symmetry"))
            .expected("a point, sphere, disc, rectangle or ellipsoid of one colour")
            .remedy("jitter by seed instead"))
    };
    if light.texture.is_some() {
        return refused("a textured light");
    }
    let alike = |a: DVec3, b: DVec3| (a.length() - b.length()).abs() <= 1e-6 * a.length().max(b.length());
    let of_plane = |[a, b]: [[f32; 3]; 2], round: bool| {
        let [a, b] = [wide(a), wide(b)];
        let regular = alike(a, b) && a.dot(b).abs() <= 1e-6 * a.length() * b.length();
        let order = match (round, regular) {
            (true, true) => None,
            (false, true) => Some(4),
            // A parallelogram or ellipse comes back after half a circle.
            _ => Some(2),
        };
        Symmetry { axis: a.cross(b).normalize_or(DVec3::Y), order }
    };
    match &light.shape {
        LightShape::Point | LightShape::Sphere => Ok(Symmetry { axis: DVec3::Y, order: None }),
        LightShape::Disc { half_axes } => Ok(of_plane(*half_axes, true)),
        LightShape::Rectangle { half_axes } => Ok(of_plane(*half_axes, false)),
        LightShape::Ellipsoid { half_axes } => {
            let axes = half_axes.map(wide);
            let equal = (0..3).find(|long| alike(axes[(long + 1) % 3], axes[(long + 2) % 3]));
            let order = if equal.is_some() { None } else { Some(2) };
            Ok(Symmetry { axis: axes[equal.unwrap_or(0)].normalize_or(DVec3::Y), order })
        }
        other => refused(&format!("a light of shape {}", other.name())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::{Sampling, sample};

    fn points(light: &Light) -> Vec<[f32; 3]> {
        sample(light, &Sampling::of_count(64)).expect("samples").positions
    }

    #[test]
    fn a_turned_disc_stays_the_disc_and_its_samples_move() {
        let light =
            Light::shaped("disc", [3.0, 4.0, 5.0], LightShape::Disc { half_axes: [[2.0, 0.0, 0.0], [0.0, 0.0, 2.0]] });
        let samples = points(&light);
        let other = turned(&light, &samples, 3, 16).expect("turns");
        assert!(other.iter().all(|[x, y, z]| (x - 3.0).hypot(z - 5.0) <= 2.0 + 1e-5 && (y - 4.0).abs() < 1e-6));
        assert!(samples.iter().zip(&other).all(|(one, other)| one != other));
        assert_eq!(turned(&light, &samples, 0, 16).expect("turns"), samples);
    }

    #[test]
    fn a_square_turns_by_quarters_and_a_rectangle_by_halves() {
        let of = |side: f32| LightShape::Rectangle { half_axes: [[1.0, 0.0, 0.0], [0.0, side, 0.0]] };
        for (side, distinct) in [(1.0, 4), (2.0, 2)] {
            let light = Light::shaped("rectangle", [0.0; 3], of(side));
            let samples = points(&light);
            let mut sets: Vec<_> = (0..16).map(|step| turned(&light, &samples, step, 16).expect("turns")).collect();
            assert!(sets.iter().flatten().all(|[x, y, _]| x.abs() <= 1.0 + 1e-6 && y.abs() <= side + 1e-6));
            sets.dedup();
            assert_eq!(sets.len(), distinct);
        }
    }

    #[test]
    fn an_ellipsoid_of_revolution_turns_about_its_own_axis() {
        let half_axes = [[1.0, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, 0.0, 1.0]];
        let light = Light::shaped("ellipsoid", [0.0; 3], LightShape::Ellipsoid { half_axes });
        for [x, y, z] in turned(&light, &points(&light), 5, 16).expect("turns") {
            assert!(x * x + 16.0 * y * y + z * z <= 1.0 + 1e-5);
        }
    }

    #[test]
    fn lights_without_symmetry_are_refused_with_a_remedy() {
        let points = LightShape::Points { positions: vec![[0.0; 3], [1.0; 3]].into(), colors: vec![].into() };
        let problem = turned(&Light::shaped("points", [0.5; 3], points), &[[0.0; 3]], 1, 4).unwrap_err();
        assert_eq!(problem.remedy.as_deref(), Some("jitter by seed instead"));
    }
}
