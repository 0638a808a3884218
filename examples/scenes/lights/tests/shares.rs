//! Weights, textures, parts, points, and what is refused.

use super::*;
use shadowgraph_core::scene::Texture;
use std::sync::Arc;

fn square() -> Light {
    Light::rectangle("test", [[-1.0, 2.0, 1.0], [1.0, 2.0, 1.0], [1.0, 2.0, -1.0], [-1.0, 2.0, -1.0]])
}

fn totals(samples: &LightSamples) -> [f64; 3] {
    [0, 1, 2].map(|c| samples.weights.iter().map(|weight| f64::from(weight[c])).sum())
}

#[test]
fn a_white_light_has_equal_shares_bit_for_bit() {
    for count in COUNTS {
        let samples = sample(&square().colored([0.25, 3.0, 0.0]), &Sampling::of_count(count)).unwrap();
        assert!(samples.weights.iter().flatten().all(|weight| *weight == 1.0 / count as f32));
        assert_eq!(samples.color, [0.25, 3.0, 0.0]);
    }
}

#[test]
fn a_mask_of_sixteen_cells_in_two_colours_is_seen_cell_by_cell() {
    // Top left, top row to the right, and so on: every other cell is red or dark, the rest blue or dark.
    let cell = |index: usize| [[1.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 0.5], [0.0; 3]][(index + index / 4) % 4];
    let texture = Texture { width: 4, height: 4, texels: (0..16).map(cell).collect() };
    let light = square().textured(texture).colored([1.0, 1.0, 2.0]);
    let samples = sample(&light, &Sampling::of_count(256)).unwrap();
    let mut shares = [[0.0; 3]; 16];
    for (point, weight) in samples.positions.iter().zip(&samples.weights) {
        // u grows along +x; the image's top is at -z, the end of the second axis.
        let column = ((point[0] + 1.0) * 2.0) as usize;
        let row = ((point[2] + 1.0) * 2.0) as usize;
        let share = &mut shares[(row * 4 + column).min(15)];
        (0..3).for_each(|c| share[c] += weight[c]);
    }
    for (index, share) in shares.iter().enumerate() {
        let expected = cell(index).map(|x| if x > 0.0 { 0.25 } else { 0.0 });
        assert!((share[0] - expected[0]).abs() < 1e-6 && (share[2] - expected[2]).abs() < 1e-6, "{index} {share:?}");
    }
    assert!(totals(&samples).iter().all(|total| (total - 1.0).abs() < 1e-6));
    assert_eq!(samples.color, [0.25, 0.0, 0.25]);
    let one = sample(&light, &Sampling::default()).unwrap();
    assert_eq!((one.positions, one.weights, one.color), (vec![light.position], vec![[1.0; 3]], [0.25, 0.0, 0.25]));
}

#[test]
fn a_globe_wears_its_texture() {
    let texels = vec![[1.0; 3], [0.0; 3]];
    let northern = Texture { width: 1, height: 2, texels };
    let light = Light::sphere("test", [0.0; 3], 1.0).textured(northern);
    let samples = sample(&light, &Sampling::of_count(100)).unwrap();
    for (point, weight) in samples.positions.iter().zip(&samples.weights) {
        // Samples on the equator may be on either side by rounding.
        assert!((weight[0] > 0.0) == (point[1] > 0.0) || point[1].abs() < 1e-9, "{point:?}");
    }
}

#[test]
fn parts_share_by_size_and_colour_whatever_the_count() {
    let part = |x: f32, radius: f32, color| Light::sphere("part", [x, 0.0, 0.0], radius).colored(color);
    let parts = vec![part(-3.0, 1.0, [1.0, 0.0, 0.0]), part(3.0, 2.0, [1.0, 1.0, 0.0])];
    let light = Light::shaped("test", [0.0; 3], LightShape::Parts(parts));
    for count in [2, 9, 100, 1000] {
        let samples = sample(&light, &Sampling::of_count(count)).unwrap();
        let red_left: f64 = samples
            .positions
            .iter()
            .zip(&samples.weights)
            .filter(|(point, _)| point[0] < 0.0)
            .map(|(_, weight)| f64::from(weight[0]))
            .sum();
        // Volumes are as 1 to 8.
        assert!((red_left - 1.0 / 9.0).abs() < 1e-6, "{count}: {red_left}");
        assert!((samples.color[0] - 1.0).abs() < 1e-6 && (samples.color[1] - 8.0 / 9.0).abs() < 1e-6);
        assert!(totals(&samples).iter().all(|total| (total - 1.0).abs() < 1e-6));
    }
}

#[test]
fn points_are_taken_as_they_are_or_chosen_without_repetition() {
    let points: Vec<[f32; 3]> = (0..10).map(|index| [0.1 * index as f32, 0.3, 7.0]).collect();
    let colors: Vec<[f32; 3]> = (0..10).map(|index| [1.0, index as f32, 0.0]).collect();
    let light = points_light("test", points.clone(), colors).unwrap();
    let all = sample(&light, &Sampling::of_count(10)).unwrap();
    assert_eq!((&all.positions, all.weights[9]), (&points, [0.1, 0.2, 0.1]));
    assert_eq!(all.color, [1.0, 4.5, 0.0]);
    let some = sample(&light, &Sampling { count: 4, seed: 2, ..Sampling::default() }).unwrap().positions;
    let mut rows: Vec<usize> = some.iter().map(|p| points.iter().position(|q| p == q).unwrap()).collect();
    rows.sort_unstable();
    rows.dedup();
    assert_eq!(rows.len(), 4);
    let problem = sample(&light, &Sampling::of_count(11)).unwrap_err();
    assert_eq!(problem.found.as_deref(), Some("11"));
    assert!(problem.message.contains("fewer points"), "{problem}");
}

#[test]
fn without_extent_all_samples_coincide() {
    let light = Light::point("test", [1.0, 2.0, 3.0]);
    let samples = sample(&light, &Sampling::of_count(7)).unwrap();
    assert_eq!(samples.positions, [[1.0, 2.0, 3.0]; 7]);
    assert!(!has_extent(&light) && has_extent(&light.with_radius(1.0)));
}

#[test]
fn what_is_no_light_is_refused_with_what_was_expected() {
    let refused = |light: Light| {
        let problem = sample(&light, &Sampling::of_count(16)).expect_err(light.shape.name());
        assert!(problem.expected.is_some() || problem.remedy.is_some(), "{problem}");
        problem.to_string()
    };
    let texture = |texels: Vec<[f32; 3]>| Texture { width: 1, height: 1, texels };
    let nan = [f32::NAN, 0.0, 0.0];
    assert!(refused(Light::point("", nan)).contains("position is no point"));
    assert!(refused(Light::sphere("", [0.0; 3], f32::INFINITY)).contains("radius"));
    assert!(refused(Light::point("", [0.0; 3]).colored([-1.0; 3])).contains("no colour"));
    assert!(refused(Light::shaped("", [0.0; 3], LightShape::Disc { half_axes: [nan; 2] })).contains("half axis 0"));
    assert!(refused(square().textured(texture(vec![[0.0; 3]]))).contains("emits nothing"));
    assert!(refused(square().textured(texture(vec![nan]))).contains("texel 0"));
    assert!(refused(square().textured(texture(vec![[1.0; 3]; 2]))).contains("another size"));
    assert!(refused(Light::shaped("", [0.0; 3], LightShape::Parts(Vec::new()))).contains("parts"));
    let flat = Arc::new(vec![[[0.0; 3]; 3]]);
    assert!(refused(Light::shaped("", [0.0; 3], LightShape::Surface(flat.clone()))).contains("no area"));
    assert!(refused(Light::shaped("", [0.0; 3], LightShape::Volume(flat))).contains("no volume"));
    let surface = LightShape::Surface(Arc::new(vec![[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]));
    let textured = Light::shaped("", [0.0; 3], surface).textured(texture(vec![[1.0; 3]]));
    assert!(refused(textured).contains("takes no texture"));
    for count in [0, MOST_SAMPLES + 1] {
        assert!(sample(&square(), &Sampling::of_count(count)).is_err());
    }
    let open = builtin::build("one-triangle").unwrap();
    assert!(volume_light("", &open).unwrap_err().to_string().contains("not closed"));
    let empty = builtin::build("empty").unwrap();
    assert!(surface_light("", &empty).is_err() && volume_light("", &empty).is_err());
    assert!(points_light("", Vec::new(), Vec::new()).is_err());
    assert!(points_light("", vec![nan], Vec::new()).is_err());
    assert!(points_light("", vec![[0.0; 3]; 2], vec![[1.0; 3]]).is_err());
}

#[test]
fn a_needle_in_its_box_is_refused_not_sought_forever() {
    let mut thin = Vec::new();
    let tip = |s: f32, dx: f32, dy: f32| [s + dx, s + dy, s];
    let e = 1e-5;
    let (a, b, c, d) = (tip(0.0, 0.0, 0.0), tip(0.0, e, 0.0), tip(0.0, 0.0, e), tip(1.0, 0.0, 0.0));
    for corners in [[a, c, b], [a, b, d], [b, c, d], [c, a, d]] {
        thin.push(corners);
    }
    let light = Light::shaped("", [0.5; 3], LightShape::Volume(Arc::new(thin)));
    let problem = sample(&light, &Sampling::of_count(4096)).unwrap_err();
    assert!(problem.message.contains("too little of its bounding box"), "{problem}");
}

#[test]
fn sets_are_disjoint_and_together_what_the_generator_gives() {
    let half_axes = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.5]];
    let light = Light::shaped("test", [0.0, 3.0, 0.0], LightShape::Rectangle { half_axes });
    let sampling = Sampling { count: 64, ..Sampling::default() };
    let sets = sample_sets(&light, &sampling, 16).unwrap();
    let sorted = |positions: Vec<[f32; 3]>| {
        let mut bits: Vec<[u32; 3]> = positions.into_iter().map(|point| point.map(f32::to_bits)).collect();
        bits.sort_unstable();
        bits
    };
    let all = sorted(sets.iter().flat_map(|set| set.positions.clone()).collect());
    assert_eq!(all, sorted(sample(&light, &Sampling::of_count(1024)).unwrap().positions));
    assert!(all.windows(2).all(|pair| pair[0] != pair[1]), "a point is in two sets");
    assert!(sets.iter().all(|set| set.positions.len() == 64 && set.weights == vec![[1.0 / 64.0; 3]; 64]));
    assert_eq!(sample_sets(&light, &sampling, 0).unwrap_err().kind, Kind::BadValue);
}

#[test]
fn the_mean_of_the_sets_colours_is_the_light_s() {
    let half_axes = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let texels = vec![[4.0, 0.0, 1.0], [0.0, 2.0, 1.0]];
    let light = Light::shaped("test", [0.0; 3], LightShape::Rectangle { half_axes });
    let light = light.textured(Texture { width: 2, height: 1, texels });
    let sets = sample_sets(&light, &Sampling::of_count(10), 7).unwrap();
    let mean = |c: usize| sets.iter().map(|set| set.color[c]).sum::<f32>() / 7.0;
    let found = [0, 1, 2].map(mean);
    assert!(found.iter().zip([2.0, 1.0, 1.0]).all(|(found, known)| (found - known).abs() < 1e-6), "{found:?}");
}
