use super::*;
use crate::shared::hard_scenes::Random;
use crate::shared::soft_scenes::{LIGHTS, soft};

fn volume(body: &Body) -> f64 {
    match body {
        Body::Solid { axes: [a, b, c], .. } => dot(*a, cross(*b, *c)).abs(),
        Body::Flat { .. } => 0.0,
    }
}

#[test]
fn a_body_holds_every_light_sample_and_the_origin() {
    let mut random = Random(3);
    let mut flat = 0;
    for (index, kind) in LIGHTS.iter().enumerate() {
        for seed in 0..40 {
            let soft = soft(100 * index as u64 + seed, kind, 1, 1);
            let origin = soft.case.light;
            for (shape, sides) in [(Shape::Sphere, 4), (Shape::Ellipsoid, 6), (Shape::Ellipsoid, 8)] {
                let body = Body::around(&soft.light, origin, shape, sides);
                flat += usize::from(matches!(body, Body::Flat { .. }));
                for _ in 0..20 {
                    let normal = random.point().map(f64::from);
                    let reached = |s: &[f32; 3]| {
                        (0..3).map(|k| normal[k] * (f64::from(s[k]) - f64::from(origin[k]))).sum::<f64>()
                    };
                    let most = soft.light.iter().map(reached).fold(0.0, f64::max);
                    assert!(body.most(normal) >= most, "{kind} {seed} {shape:?} {sides}");
                    assert!(body.most(normal) <= body.reach() * size(normal));
                }
            }
        }
    }
    // Points, discs and rectangles, where coordinates are not too coarse for them, and nothing else.
    assert!((400..=480).contains(&flat), "{flat}");
}

#[test]
fn a_square_light_with_four_sides_is_itself() {
    let corners = [[-1.0, 5.0, -1.0], [1.0, 5.0, -1.0], [1.0, 5.0, 1.0], [-1.0, 5.0, 1.0]];
    let body = Body::around(&corners, [0.0, 5.0, 0.0], Shape::Ellipsoid, 4);
    let Body::Flat { thickness, .. } = body else { unreachable!("it is planar") };
    assert!(thickness < 1e-8);
    assert!((body.most([1.0, 0.0, 0.0]) - 1.0).abs() < 1e-6 && (body.most([1.0, 0.0, 1.0]) - 2.0).abs() < 1e-6);
    assert!(body.most([0.0, 1.0, 0.0]) < 1e-8);
}

#[test]
fn a_single_light_sample_has_no_extent() {
    let body = Body::around(&[[3.0, 4.0, 5.0]], [3.0, 4.0, 5.0], Shape::Sphere, 6);
    assert_eq!((body.most([1.0, 2.0, 3.0]), body.reach()), (0.0, 0.0));
}

#[test]
fn an_ellipsoid_takes_less_room_than_a_ball_around_a_long_light() {
    let long: Vec<[f32; 3]> = (0..500)
        .scan(Random(9), |random, _| Some(random.point()))
        .filter(|p| p.iter().map(|x| x * x).sum::<f32>() <= 1.0)
        .map(|[x, y, z]| [x + y, 4.0 * y - x, 0.2 * z])
        .collect();
    let [ball, ellipsoid] = [Shape::Sphere, Shape::Ellipsoid].map(|shape| Body::around(&long, [0.0; 3], shape, 6));
    assert!(volume(&ellipsoid) < 0.1 * volume(&ball));
}
