//! Any numbers for any shape: samples or a problem, never a panic.

use super::*;
use proptest::prelude::*;
use shadowgraph_core::scene::Texture;
use std::sync::Arc;

/// Ordinary numbers and the worst ones.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -10.0f32..10.0,
        1 => prop::sample::select(vec![0.0, -0.0, f32::NAN, f32::INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-45, 1e12, -1e12]),
    ]
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    [number(), number(), number()]
}

fn shape() -> impl Strategy<Value = LightShape> {
    let triangles = || prop::collection::vec([point(), point(), point()], 0..12).prop_map(Arc::new);
    let axes = || [point(), point()];
    let flat = prop_oneof![
        Just(LightShape::Point),
        Just(LightShape::Sphere),
        axes().prop_map(|half_axes| LightShape::Disc { half_axes }),
        axes().prop_map(|half_axes| LightShape::Rectangle { half_axes }),
        [point(), point(), point()].prop_map(|half_axes| LightShape::Ellipsoid { half_axes }),
        (prop::collection::vec(point(), 0..6), prop::collection::vec(point(), 0..6))
            .prop_map(|(positions, colors)| LightShape::Points { positions: positions.into(), colors: colors.into() }),
        triangles().prop_map(LightShape::Surface),
        triangles().prop_map(LightShape::Volume),
    ];
    flat.prop_recursive(3, 8, 3, |inner| {
        let part = (point(), inner).prop_map(|(position, shape)| Light::shaped("part", position, shape));
        prop::collection::vec(part, 0..3).prop_map(LightShape::Parts)
    })
}

fn light() -> impl Strategy<Value = Light> {
    let texture =
        prop::collection::vec(point(), 1..5).prop_map(|texels| Texture { width: texels.len(), height: 1, texels });
    (point(), number(), shape(), point(), prop::option::weighted(0.2, texture)).prop_map(
        |(position, radius, shape, color, texture)| Light {
            radius,
            color: color.map(f32::abs),
            texture: texture.map(Arc::new),
            ..Light::shaped("fuzz", position, shape)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn samples_are_numbers_or_there_is_a_problem(
        light in light(),
        generator in prop::sample::select(Generator::ALL.to_vec()),
        count in 0usize..40,
        seed in any::<u32>(),
        to in point(),
        radius in number(),
    ) {
        for light in [light.clone(), light.moved_to(to).with_radius(radius)] {
            if let Ok(samples) = sample(&light, &Sampling { generator, count, seed }) {
                prop_assert_eq!([samples.positions.len(), samples.weights.len()], [count; 2]);
                prop_assert!(samples.positions.iter().flatten().all(|x| x.is_finite()), "{:?}", samples.positions);
                for channel in 0..3 {
                    let total: f32 = samples.weights.iter().map(|weight| weight[channel]).sum();
                    prop_assert!((total - 1.0).abs() < 1e-3, "{:?}", samples.weights);
                }
                prop_assert!(samples.color.iter().all(|x| x.is_finite() && *x >= 0.0), "{:?}", samples.color);
            }
        }
    }
}
