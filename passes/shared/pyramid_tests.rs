use super::*;
use crate::shared::hard_scenes::{Case, Random, random};
use crate::shared::predicate::Pyramid;

/// Calls `check` with face, caster and view-sample for every kept, projected view-sample of its own face.
fn each_pair(case: &Case, mut check: impl FnMut(&LightSpace, &Corners, [f32; 3], &Spot)) {
    let spaces: Vec<LightSpace> = case.faces.iter().map(LightSpace::new).collect();
    for (position, state) in case.position.iter().zip(&case.state) {
        let Some(point) = crate::shared::light_frame::project(&case.faces, (*position).into()) else {
            continue;
        };
        let (spot, tame) = spaces[point.face].project(*position);
        if *state == 1 && tame {
            for caster in &case.triangles {
                check(&spaces[point.face], caster, *position, &spot);
            }
        }
    }
}

#[test]
fn what_planes_are_sure_of_is_true() {
    let (mut sure, mut unsure) = (0u32, 0u32);
    for seed in 0..120 {
        let case = random(seed, 20, 60);
        each_pair(&case, |space, caster, position, spot| {
            let truth = Pyramid::new(caster, case.light).covers(position);
            match space.reach(caster) {
                Reach::Nothing => assert!(!truth, "seed {seed}"),
                Reach::Anything => {}
                Reach::Cone(cone) => {
                    match cone.covers(spot) {
                        Some(answer) => assert_eq!(answer, truth, "seed {seed} {caster:?} {position:?}"),
                        None => unsure += 1,
                    }
                    sure += 1;
                    let extent = [spot.u, spot.v].map(|x| f64::from(x.abs()));
                    for slack in [1.0, 7.0, 300.0] {
                        let planes = Planes::new(&cone, extent.map(|x| x * slack));
                        assert!(planes.may_cover(spot) || !truth, "seed {seed} {caster:?} {position:?}");
                    }
                }
            }
        });
    }
    // Every view-sample lies on one caster, many on corners and edges; all others are decided.
    assert!(sure > 60_000 && unsure < sure / 12, "{unsure} of {sure}");
}

#[test]
fn a_tiny_far_triangle_stays_decidable() {
    // Edges of 1e-4 seen from 1e3: 1e-7 of a turn. Its middle and points one edge length away are decided.
    let face = Face {
        origin: glam::Vec3::ZERO,
        valid: true,
        axis_x: glam::Vec3::X,
        axis_y: glam::Vec3::Y,
        axis_z: glam::Vec3::Z,
        window_low: [-1.0; 2],
        window_size: [2.0; 2],
        near: 1.0,
        far: 1e4,
    };
    let space = LightSpace::new(&face);
    let step = 1e-4;
    let caster = [[0.0, 0.0, 1e3], [step, 0.0, 1e3], [0.0, step, 1e3]];
    let Reach::Cone(cone) = space.reach(&caster) else { unreachable!("it has a cone") };
    let covers = |x: f32, y: f32| cone.covers(&space.project([2.0 * x * step, 2.0 * y * step, 2e3]).0);
    assert_eq!(covers(0.25, 0.25), Some(true));
    assert_eq!(covers(1.0, 1.0), Some(false));
    assert_eq!(covers(-0.5, 0.25), Some(false));
    assert_eq!(covers(0.5, 0.5), None);
    // In front of the triangle, within its pyramid.
    assert_eq!(cone.covers(&space.project([0.25 * step, 0.25 * step, 999.0]).0), Some(false));
}

#[test]
fn the_light_in_the_plane_of_a_caster() {
    let case = random(0, 1, 1);
    let face = Face { origin: glam::Vec3::ZERO, ..case.faces[0] };
    let space = LightSpace::new(&face);
    let around = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    assert!(matches!(space.reach(&around), Reach::Anything));
    let beside = around.map(|[x, y, z]| [x + 3.0, y, z]);
    assert!(matches!(space.reach(&beside), Reach::Nothing));
    assert!(matches!(space.reach(&[[5.0; 3]; 3]), Reach::Nothing));
}

#[test]
fn mirrored_axes_change_nothing() {
    let mut random_numbers = Random(4);
    for seed in 0..40 {
        let case = random(seed, 10, 20);
        let mirrored = case.faces.iter().map(|face| Face { axis_x: -face.axis_x, ..*face });
        for (face, mirrored) in case.faces.iter().zip(mirrored) {
            let spaces = [LightSpace::new(face), LightSpace::new(&mirrored)];
            for caster in &case.triangles {
                let position = case.position[random_numbers.below(20)];
                let answers = spaces.map(|space| match space.reach(caster) {
                    Reach::Cone(cone) => space.project(position).1.then(|| cone.covers(&space.project(position).0)),
                    _ => None,
                });
                assert_eq!(answers[0], answers[1], "seed {seed}");
            }
        }
    }
}
