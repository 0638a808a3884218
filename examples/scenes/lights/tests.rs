//! Every shape with every generator and count: inside, spread evenly, better than chance, the same bits twice.

mod fuzz;
mod shares;

use super::*;
use crate::builtin;
use crate::random::Random;
use glam::{DVec3, Vec3, dvec3};

/// Small, even, odd, prime to every base, no square, no cube, the most.
const COUNTS: [usize; 8] = [1, 2, 3, 16, 100, 256, 1000, 4096];

/// A light of each shape with a map from world space to a unit shape: the square or disc of radius 1, the ball of radius 1.
struct Case {
    light: Light,
    /// Whether a point belongs to the light, within rounding.
    holds: Box<dyn Fn(DVec3) -> bool>,
}

fn wide(point: [f32; 3]) -> DVec3 {
    Vec3::from(point).as_dvec3()
}

/// Coordinates of `point` along `axes` from `centre`.
fn along(point: DVec3, centre: DVec3, axes: [DVec3; 3]) -> DVec3 {
    glam::DMat3::from_cols(axes[0], axes[1], axes[2]).inverse() * (point - centre)
}

fn cases() -> Vec<Case> {
    const EDGE: f64 = 1.0 + 1e-6;
    let centre = [0.5, 4.5, -0.25];
    let (u, v, w) = ([0.5, 0.25, 0.0], [-0.25, 0.5, 0.125], [0.0, 0.125, 0.75]);
    let axes = [wide(u), wide(v), wide(w)];
    let flat = [axes[0], axes[1], axes[0].cross(axes[1])];
    let is_flat = |p: DVec3| p.z.abs() < 1e-5;
    let at = move |p| along(p, wide(centre), axes);
    let on = move |p| along(p, wide(centre), flat);
    let shaped = |shape| Light::shaped("test", centre, shape);
    let knot = builtin::build("torus-knot?segments=32&sides=8").unwrap();
    let mesh = closed_part(&knot);
    let volume = super::volume::Volume::new(&mesh.positions);
    let surface = mesh.positions.clone();
    let points: Vec<[f32; 3]> = (0..4096).map(|index| [index as f32, 2.0, -1.0]).collect();
    let ball = |x: f32, radius| Light::sphere("part", [x, 1.0, 0.0], radius);
    let dumbbell = Light::shaped("test", [0.0, 1.0, 0.0], LightShape::Parts(vec![ball(-1.0, 0.25), ball(1.0, 0.25)]));
    let in_part = |p: DVec3| [-1.0, 1.0].iter().any(|x| (p - dvec3(*x, 1.0, 0.0)).length() <= 0.25 * EDGE);
    let case = |light, holds| Case { light, holds };
    vec![
        case(Light::sphere("test", centre, 2.0), Box::new(move |p| (p - wide(centre)).length() <= 2.0 * EDGE)),
        case(
            shaped(LightShape::Disc { half_axes: [u, v] }),
            Box::new(move |p| is_flat(on(p)) && on(p).truncate().length() <= EDGE),
        ),
        case(
            shaped(LightShape::Rectangle { half_axes: [u, v] }),
            Box::new(move |p| is_flat(on(p)) && on(p).truncate().abs().max_element() <= EDGE),
        ),
        case(shaped(LightShape::Ellipsoid { half_axes: [u, v, w] }), Box::new(move |p| at(p).length() <= EDGE)),
        case(points_light("test", points, Vec::new()).unwrap(), Box::new(|p| p.x.fract() == 0.0 && p.y == 2.0)),
        case(surface_light("test", &mesh).unwrap(), Box::new(move |p| is_on(&surface, p))),
        case(volume_light("test", &mesh).unwrap(), Box::new(move |p| volume.holds(p))),
        case(dumbbell, Box::new(in_part)),
    ]
}

/// The closed triangles of a scene as a scene.
fn closed_part(scene: &shadowgraph_core::scene::Scene) -> shadowgraph_core::scene::Scene {
    let closed = shadowgraph_core::scene::flag::CLOSED;
    let rows: Vec<usize> = (0..scene.triangle_count()).filter(|row| scene.flags[*row] & closed != 0).collect();
    shadowgraph_core::scene::Scene {
        positions: rows.iter().map(|row| scene.positions[*row]).collect(),
        flags: rows.iter().map(|row| scene.flags[*row]).collect(),
        ..Default::default()
    }
}

/// Whether a triangle passes within rounding of the point.
fn is_on(triangles: &[[[f32; 3]; 3]], point: DVec3) -> bool {
    triangles.iter().any(|corners| {
        let [a, b, c] = corners.map(wide);
        let normal = (b - a).cross(c - a);
        let weights = along(point, a, [b - a, c - a, normal.normalize()]);
        weights.z.abs() < 1e-5 && weights.x > -1e-4 && weights.y > -1e-4 && weights.x + weights.y < 1.0 + 1e-4
    })
}

fn samples_of(light: &Light, generator: Generator, count: usize, seed: u32) -> Vec<[f32; 3]> {
    let samples = sample(light, &Sampling { generator, count, seed }).unwrap();
    assert_eq!([samples.positions.len(), samples.weights.len()], [count; 2]);
    samples.positions
}

#[test]
fn every_sample_is_on_its_light_and_has_the_same_bits_twice() {
    for case in cases() {
        for generator in Generator::ALL {
            for count in COUNTS {
                let found = samples_of(&case.light, generator, count, 3);
                let name = case.light.shape.name();
                assert_eq!(found, samples_of(&case.light, generator, count, 3), "{name} {generator:?} {count}");
                if count == 1 {
                    assert_eq!(found, [case.light.position]);
                    continue;
                }
                let reach = f64::from(case.light.radius) * (1.0 + 1e-6);
                for point in found {
                    let point = wide(point);
                    assert!(point.is_finite() && (case.holds)(point), "{name} {generator:?} {count}: {point}");
                    assert!((point - wide(case.light.position)).length() <= reach + 1e-6, "{name}: {point}");
                }
            }
        }
    }
}

#[test]
fn seeds_choose_other_samples_and_the_mean_stays_near_the_centre() {
    for case in cases() {
        let name = case.light.shape.name();
        for generator in Generator::ALL {
            // All points of a set are taken as they are.
            if name != "points" {
                let at = |seed| samples_of(&case.light, generator, 64, seed);
                assert_ne!(at(1), at(2), "{name} {generator:?}");
            }
            for count in [256, 1000, 4096] {
                let points = samples_of(&case.light, generator, count, 7);
                let mean = points.iter().map(|point| wide(*point)).sum::<DVec3>() / count as f64;
                let off = (mean - wide(case.light.position)).length() / f64::from(case.light.radius);
                // Four standard deviations of white noise of unit variance.
                let most = 4.0 / (count as f64).sqrt();
                assert!(off < most, "{name} {generator:?} {count}: {off} of the radius");
            }
        }
    }
}

/// Chi-square over cells of equal area or volume, as the mean of its standard normal form over some seeds.
fn unevenness(light: &Light, generator: Generator, count: usize, cell: Cell, cells: usize) -> f64 {
    let of_seed = |seed| {
        let mut seen = vec![0.0; cells];
        for point in samples_of(light, generator, count, seed) {
            seen[cell(wide(point))] += 1.0;
        }
        let expected = count as f64 / cells as f64;
        let chi: f64 = seen.iter().map(|seen| (seen - expected).powi(2) / expected).sum();
        let freedom = cells as f64 - 1.0;
        (chi - freedom) / (2.0 * freedom).sqrt()
    };
    (1..=8).map(of_seed).sum::<f64>() / 8.0
}

/// Number of the cell that a point lies in.
type Cell<'a> = &'a dyn Fn(DVec3) -> usize;

#[test]
fn areas_and_volumes_are_filled_evenly_and_better_than_by_chance() {
    let steps = |x: f64, steps: usize| ((x * steps as f64) as usize).min(steps - 1);
    let turn = |p: DVec3| 0.5 + p.y.atan2(p.x) / std::f64::consts::TAU;
    let axes = [[0.5, 0.25, 0.0], [-0.25, 0.5, 0.0], [0.0, 0.125, 0.75]];
    let (centre, frame) = (dvec3(0.0, 2.0, 0.0), axes.map(wide));
    let shaped = |shape| Light::shaped("test", [0.0, 2.0, 0.0], shape);
    let flat = [axes[0], axes[1]];
    let own = move |p: DVec3| along(p, centre, frame);
    // Rings and shells of equal area and volume by angle; columns by rows; halves of the ball by height too.
    let disc = move |p: DVec3| steps(own(p).length_squared(), 4) * 8 + steps(turn(own(p)), 8);
    let square = move |p: DVec3| steps((own(p).x + 1.0) / 2.0, 6) * 6 + steps((own(p).y + 1.0) / 2.0, 6);
    let ball = move |p: DVec3| {
        let p = own(p);
        (steps(p.length().powi(3), 3) * 4 + steps(turn(p), 4)) * 3 + steps((p.z / p.length() + 1.0) / 2.0, 3)
    };
    let lights: [(Light, Cell, usize); 3] = [
        (shaped(LightShape::Disc { half_axes: flat }), &disc, 32),
        (shaped(LightShape::Rectangle { half_axes: flat }), &square, 36),
        (shaped(LightShape::Ellipsoid { half_axes: axes }), &ball, 36),
    ];
    for (light, cell, cells) in &lights {
        for count in [256, 1000, 4096] {
            let of = |generator| unevenness(light, generator, count, cell, *cells);
            let name = light.shape.name();
            let by_chance = of(Generator::Random);
            // The control: chance is even in the mean (eight seeds: a deviation of 0.35), and no better.
            assert!(by_chance.abs() < 1.5, "{name} {count}: {by_chance}");
            for generator in [Generator::Hammersley, Generator::Jittered, Generator::Lattice] {
                assert!(of(generator) < by_chance - 1.0, "{name} {generator:?} {count}: {}", of(generator));
            }
        }
        // And the judge sees what is uneven: a ball that is filled by radius, not by volume.
        let skewed = |p: DVec3| cell(centre + (p - centre) * 0.8);
        assert!(unevenness(light, Generator::Random, 4096, &skewed, *cells) > 5.0);
    }
}

#[test]
fn meshes_are_filled_evenly() {
    let mesh = closed_part(&builtin::build("torus-knot?segments=32&sides=8").unwrap());
    let surface = super::surface::Surface::new(&mesh.positions);
    let light = surface_light("test", &mesh).unwrap();
    // Which triangle a point came from is unknown: quarters of the knot by angle, with their areas.
    let quarter = |p: DVec3| ((0.5 + p.z.atan2(p.x) / std::f64::consts::TAU) * 4.0).min(3.0) as usize;
    let many = Random::new(1);
    let share = |points: &mut dyn Iterator<Item = DVec3>| {
        let mut seen = [0.0f64; 4];
        let mut total = 0.0;
        for point in points {
            seen[quarter(point)] += 1.0;
            total += 1.0;
        }
        seen.map(|seen| seen / total)
    };
    let mut random = many;
    let mut judge = (0..100_000).map(|_| surface.point([random.unit(), random.unit()]));
    let expected = share(&mut judge);
    for generator in Generator::ALL {
        let found = share(&mut samples_of(&light, generator, 4096, 1).into_iter().map(wide));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 0.03, "{generator:?} {found} {expected}");
        }
    }
    // Second moments of the inside against brute force.
    let light = volume_light("test", &mesh).unwrap();
    let volume = super::volume::Volume::new(&mesh.positions);
    let brute = volume.points(Sequence { generator: Generator::Random, seed: 99, stream: 0 }, 30_000).unwrap();
    let spread = |points: &[DVec3]| {
        let centre = wide(light.position);
        points.iter().map(|p| (*p - centre) * (*p - centre)).sum::<DVec3>() / points.len() as f64
    };
    for generator in Generator::ALL {
        let found: Vec<DVec3> = samples_of(&light, generator, 4096, 1).into_iter().map(wide).collect();
        let ratio = spread(&found) / spread(&brute);
        assert!((ratio - 1.0).abs().max_element() < 0.06, "{generator:?} {ratio}");
    }
}

#[test]
fn flat_lights_are_planar_and_solid_ones_are_not() {
    use shadowgraph_core::input::facts;
    let scene = shadowgraph_core::scene::Scene::default();
    for case in cases() {
        let is_flat = matches!(case.light.shape, LightShape::Disc { .. } | LightShape::Rectangle { .. });
        for place in [[0.0; 3], [0.5, 4.5, -0.25], [1e4, -3e4, 2e4]] {
            let light = case.light.clone().moved_to(place);
            for (generator, count) in [(Generator::Hammersley, 256), (Generator::Random, 4096), (Generator::Lattice, 5)]
            {
                let points = samples_of(&light, generator, count, 1);
                let is_points = matches!(case.light.shape, LightShape::Points { .. });
                let expected = is_flat || is_points;
                assert_eq!(facts(&scene, &points, false).light_is_planar, expected, "{} {place:?}", light.shape.name());
            }
        }
    }
}
