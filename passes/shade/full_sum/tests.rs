use super::cpu::LightSum;
use super::{PASS, light_shape};
use crate::shade::params::Settings;
use crate::shade::reflection::Reflection;
use crate::shade::surface::{Surface, reflected};
use crate::shared::hard_scenes::Random;
use crate::shared::shading::unit;
use glam::Vec3;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::Kind;

fn floor() -> Surface {
    Surface {
        position: Vec3::ZERO,
        triangle: 0,
        weights: Vec3::splat(1.0 / 3.0),
        is_flipped: false,
        geometric_normal: Vec3::Y,
        shading_normal: Vec3::Y,
        toward_light: Vec3::Y,
        albedo: Vec3::ONE,
        light: Vec3::ONE,
        visible: Vec3::ONE,
    }
}

fn settings(falloff_distance: Option<f32>) -> Settings {
    Settings { falloff_distance, ..Settings::new(&Params::defaults(PASS.params)) }
}

const MATT: Reflection = Reflection { specular: 0.0, shininess: 32.0 };
const EYE: Vec3 = Vec3::new(0.0, 9.0, 0.0);

#[test]
fn cosine_falloff_colour_bit_and_horizon_are_counted_by_hand() {
    // Right above, at cosine 0.6, at cosine 0.8, below the plane, grazing it.
    let samples = [[0.0, 2.0, 0.0], [4.0, 3.0, 0.0], [0.0, 4.0, -3.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]];
    let weights = [[0.5, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, 0.0, 1.0], [9.0; 3], [9.0; 3]];
    let mut sum = LightSum { samples: &samples, weights: &weights, reflection: MATT, settings: settings(None) };
    let close = |found: Vec3, expected: [f32; 3]| {
        assert!((found - Vec3::from(expected)).length() < 1e-6, "{found} not {expected:?}");
    };
    close(sum.terms(&floor(), EYE, &[0])[0], [0.5, 0.15, 0.8]);
    close(sum.terms(&floor(), EYE, &[0b010])[0], [0.5, 0.0, 0.8]);
    close(sum.terms(&floor(), EYE, &[u32::MAX])[0], [0.0; 3]);
    // Distances 2, 5, 5; full strength at 2.
    sum.settings = settings(Some(2.0));
    close(sum.terms(&floor(), EYE, &[0])[0], [0.5, 0.15 * 0.16, 0.8 * 0.16]);
    // A leak of the interpolated normal is no light: the plane itself turns away.
    let turned = Surface { geometric_normal: -Vec3::Y, ..floor() };
    close(sum.terms(&turned, EYE, &[0b1_0111])[0], [0.0; 3]);
}

#[test]
fn the_highlight_is_where_the_mirrored_light_sample_is_seen() {
    let (samples, weights) = ([[3.0, 4.0, 0.0]], [[0.5, 1.0, 0.25]]);
    let reflection = Reflection { specular: 2.0, shininess: 2.0 };
    let sum = LightSum { samples: &samples, weights: &weights, reflection, settings: settings(None) };
    let highlight = |eye| sum.terms(&floor(), eye, &[0])[1];
    assert!((highlight(Vec3::new(-3.0, 4.0, 0.0)) - Vec3::new(1.0, 2.0, 0.5)).length() < 1e-6);
    // Straight above the cosine of the angle to the mirrored direction is 0.8.
    assert!((highlight(EYE) - 0.64 * Vec3::new(1.0, 2.0, 0.5)).length() < 1e-6);
    // Towards the light itself it is 0.28.
    assert!((highlight(Vec3::new(3.0, 4.0, 0.0)).x - 0.28f32.powi(2)).abs() < 1e-6);
}

#[test]
fn one_light_sample_at_the_centre_is_phong() {
    let mut random = Random(7);
    let mut lit_count = 0;
    for round in 0..2000 {
        let falloff = (round % 2 == 0).then_some(1.5);
        let [position, centre, eye] = [(); 3].map(|()| Vec3::from(random.point()) * 4.0);
        let normal = unit(Vec3::from(random.point()));
        let shading_normal = unit(normal + 0.3 * Vec3::from(random.point()));
        let offset = centre - position;
        let reflection = Reflection { specular: 0.7, shininess: 5.0 };
        let settings = settings(falloff);
        let surface = Surface {
            position,
            geometric_normal: normal,
            shading_normal,
            toward_light: unit(offset),
            albedo: Vec3::new(0.2, 0.5, 0.9),
            light: Vec3::new(1.0, 0.5, 2.0) / settings.weakening(offset),
            ..floor()
        };
        let samples = [centre.to_array()];
        let sum = LightSum { samples: &samples, weights: &[[1.0; 3]], reflection, settings };
        let [cosines, highlights] = sum.terms(&surface, eye, &[0]);
        let found = Vec3::new(1.0, 0.5, 2.0) * (surface.albedo * cosines + highlights);
        let faces_away = offset.dot(normal) <= 0.0;
        let expected = if faces_away { Vec3::ZERO } else { reflected(&surface, eye, reflection) };
        assert!((found - expected).abs().max_element() <= 1e-5 * expected.max_element().max(1.0), "{surface:?}");
        lit_count += usize::from(expected != Vec3::ZERO);
    }
    assert!(lit_count > 500, "{lit_count}");
}

#[test]
fn what_is_missing_or_does_not_belong_together_is_told() {
    let shapes: [(&str, &[usize]); 3] = [("mask", &[9, 2]), ("light_samples", &[33, 3]), ("light_weights", &[33, 3])];
    let find = |name: &str| shapes.iter().find(|(port, _)| *port == name).map(|(_, shape)| *shape);
    assert_eq!(light_shape(find).expect("fits"), [33, 2]);
    let problem = light_shape(|name| find(name).filter(|_| name != "mask")).expect_err("no mask");
    assert_eq!((problem.kind, problem.port.as_deref()), (Kind::Missing, Some("mask")));
    let other = light_shape(|name| if name == "mask" { Some(&[9, 1]) } else { find(name) });
    assert_eq!(other.expect_err("one word for 33").kind, Kind::BadValue);
}
