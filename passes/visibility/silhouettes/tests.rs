use super::PASS;
use super::cpu::{edges_of, masks};
use super::edges::Edges;
use crate::shared::area_light_scenes::{SoftCase, soft, soft_planar};
use crate::shared::hard_scenes::{Case, Random, output, random, run};
use crate::shared::light_box::LightBox;
use crate::shared::predicate::Corners;
use crate::shared::soft::Soft;
use fearless_simd::Level;
use shadowgraph_core::shared::KEPT;

/// The mask, and what was counted.
fn mask(case: &SoftCase, more: usize) -> (Vec<u32>, Vec<u64>) {
    let (outputs, counts) = run(&PASS, &case.inputs(more)).unwrap();
    (output(&outputs, "mask").as_u32().to_vec(), counts)
}

/// Counter `name`.
fn count(counts: &[u64], name: &str) -> u64 {
    counts[PASS.counters.iter().position(|counter| counter.name == name).unwrap()]
}

#[test]
fn random_scenes_have_no_wrong_bit() {
    let (mut partial, mut crossing, mut exact) = (0, 0, 0);
    for (round, light_sample_count) in [1, 5, 32, 33, 128, 256].into_iter().enumerate() {
        for seed in 0..24 {
            let case = soft(100 * round as u64 + seed, 6 + 12 * (seed % 4) as usize, 60, light_sample_count);
            let expected = case.mask();
            let (found, counts) = mask(&case, 1 + seed as usize % 5);
            assert_eq!(found, expected, "{light_sample_count} light samples, seed {seed}");
            partial += expected.iter().filter(|word| **word != 0 && **word != u32::MAX).count();
            crossing += count(&counts, "crossing");
            exact += count(&counts, "exact");
        }
    }
    assert!(partial > 3000 && crossing > 1000 && exact > 0, "{partial} words are penumbra, {crossing}, {exact}");
}

#[test]
fn planar_lights_have_no_wrong_bit() {
    for seed in 0..24 {
        let case = soft_planar(8000 + seed, 40, 60, 64);
        assert_eq!(mask(&case, 1).0, case.mask(), "seed {seed}");
    }
}

#[test]
fn a_thousand_light_samples_have_no_wrong_bit() {
    for seed in 0..4 {
        let case = soft(7000 + seed, 12, 24, 1000);
        assert_eq!(mask(&case, 2).0, case.mask(), "seed {seed}");
    }
}

#[test]
fn one_light_sample_gives_the_hard_mask() {
    for seed in 0..60 {
        let hard = random(seed, 20, 200);
        let expected = hard.mask();
        let case = SoftCase { samples: vec![hard.light], case: hard };
        assert_eq!(mask(&case, 1 + seed as usize % 3).0, expected, "seed {seed}");
    }
}

/// A closed surface of triangles: a ball with waves, `rings` by `turns`, about `centre`.
fn ball(rings: usize, turns: usize, centre: [f32; 3], radius: f32) -> Vec<Corners> {
    let corner = |ring: usize, turn: usize| {
        let a = ring as f32 / rings as f32 * std::f32::consts::PI;
        let b = (turn % turns) as f32 / turns as f32 * std::f32::consts::TAU;
        // Poles are single points.
        let s = if ring == 0 || ring == rings { 0.0 } else { a.sin() };
        let r = radius * (1.0 + 0.1 * (5.0 * b).sin() * (3.0 * a).sin() * s);
        [centre[0] + r * s * b.cos(), centre[1] + radius * a.cos(), centre[2] + r * s * b.sin()]
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for turn in 0..turns {
            let [a, b, c, d] =
                [corner(ring, turn), corner(ring, turn + 1), corner(ring + 1, turn), corner(ring + 1, turn + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    triangles
}

const FLOOR: [Corners; 2] = [
    [[-4.0, -1.5, -4.0], [-4.0, -1.5, 4.0], [4.0, -1.5, -4.0]],
    [[4.0, -1.5, 4.0], [4.0, -1.5, -4.0], [-4.0, -1.5, 4.0]],
];

/// The point of `triangle` at (s, t), rounded.
fn on(triangle: &Corners, mut s: f32, mut t: f32) -> [f32; 3] {
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    let [a, b, c] = *triangle;
    [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
}

/// A scene over the floor: `triangles`, view-samples on the floor and, every `every`-th, on them.
fn scene(mut triangles: Vec<Corners>, rows: usize, every: usize, light: [f32; 3], side: usize, seed: u64) -> Case {
    let above = triangles.len();
    triangles.extend(FLOOR);
    let r = &mut Random(seed);
    let (mut position, mut triangle) = (Vec::new(), Vec::new());
    for row in 0..rows {
        let own = if row % every == 0 && above > 0 { r.below(above) } else { above + row % 2 };
        let [s, t] = [0.5 + 0.5 * r.signed(), 0.5 + 0.5 * r.signed()];
        // Towards the corner that both have near the middle.
        let [s, t] = if own < above { [s, t] } else { [0.5 + 0.2 * (s - 0.5), 0.5 + 0.2 * (t - 0.5)] };
        position.push(on(&triangles[own], s, t));
        triangle.push(own as u32);
    }
    let mut case = Case {
        casts: vec![1; triangles.len()],
        triangles,
        light,
        state: vec![KEPT; position.len()],
        position,
        triangle,
        faces: Vec::new(),
        side,
    };
    case.look(false, false);
    case
}

/// Samples of a ball.
fn lamp(count: usize, centre: [f32; 3], radius: f32, seed: u64) -> Vec<[f32; 3]> {
    let r = &mut Random(seed);
    let points = std::iter::repeat_with(move || r.point()).filter(|p| p.iter().map(|x| x * x).sum::<f32>() <= 1.0);
    points.take(count).map(|p| [0, 1, 2].map(|k| centre[k] + radius * p[k])).collect()
}

/// What the pass finds, and its counts: edges crossed, view-samples counted, borders, recounted, left.
fn find(case: &SoftCase, level: Level, plant: impl Fn(&mut Edges)) -> (Vec<u32>, Vec<u64>) {
    let inputs = case.inputs(1);
    let get = |port| output(&inputs, port);
    let soft = Soft {
        penumbra_state: None,
        triangles: &case.case.triangles,
        caster_state: &case.case.casts,
        position: &case.case.position,
        triangle: &case.case.triangle,
        sample_state: &case.case.state,
        cell: get("cell").as_u32(),
        listed: &get("list_entries").as_u32()[..get("list_offset").as_u32().last().copied().unwrap() as usize],
        caster_offset: get("caster_offset").as_u32(),
        caster_entries: get("caster_entries").as_u32(),
        light: LightBox::clustered(&case.samples),
    };
    let mut edges = edges_of(&soft);
    plant(&mut edges);
    let (found, counts) = masks(&soft, &edges, level, &|_, _| {});
    (found, vec![counts.crossing, counts.counted, counts.borders, counts.recounted, counts.left])
}

fn agrees(what: &str, case: &SoftCase) -> Vec<u64> {
    let expected = case.mask();
    let mut counted = Vec::new();
    for level in [Level::new(), Level::baseline()] {
        let (found, counts) = find(case, level, |_| {});
        let wrong: u32 = found.iter().zip(&expected).map(|(a, b)| (a ^ b).count_ones()).sum();
        assert_eq!(wrong, 0, "{what}, {level:?}");
        counted = counts;
    }
    counted
}

#[test]
fn one_wrong_jump_is_seen() {
    // A board: four open edges and one between its two triangles, each walked the wrong way by one triangle in turn.
    let [a, b, c, d] = [[-0.4, 0.0, -0.4], [0.4, 0.0, -0.4], [-0.4, 0.0, 0.4], [0.4, 0.0, 0.4]];
    let light = [0.1, 2.0, 0.0];
    let case =
        SoftCase { samples: lamp(64, light, 0.8, 3), case: scene(vec![[a, c, b], [b, c, d]], 200, 200, light, 2, 3) };
    let expected = case.mask();
    assert_eq!(find(&case, Level::new(), |_| {}).0, expected);
    for triangle in 0..2 {
        for edge in 0..3 {
            let (found, _) = find(&case, Level::new(), |edges| edges.of[triangle][edge] ^= 1);
            assert_ne!(found, expected, "edge {edge} of triangle {triangle}");
        }
    }
    // Among joined casters: an edge that no longer balances.
    let light = [0.4, 4.0, 0.2];
    let case = scene(ball(16, 24, [0.0; 3], 0.6), 300, 3, light, 8, 1);
    let case = SoftCase { samples: lamp(64, light, 0.6, 3), case };
    let expected = case.mask();
    let (found, counts) = find(&case, Level::new(), |_| {});
    assert!(found == expected && counts[2] > 0, "borders: {counts:?}");
    let is_seen = |triangle: usize| find(&case, Level::new(), |edges| edges.of[triangle][0] ^= 1).0 != expected;
    let seen = (0..60).filter(|k| is_seen(12 * k + 3)).count();
    assert!(seen > 10, "only {seen} of 60 wrong edges were seen");
}

#[test]
fn closed_waves_over_a_floor_agree() {
    let mut sums = [0; 5];
    for (seed, radius) in [(1, 0.3), (2, 0.05), (3, 1.0)] {
        for side in [1, 4, 16] {
            let light = [0.4, 4.0, 0.2];
            let case = scene(ball(16, 24, [0.0; 3], 0.6), 300, 3, light, side, seed);
            let counts = agrees("waves", &SoftCase { samples: lamp(70, light, radius, seed), case });
            sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        }
    }
    assert!(sums[0] > 2000 && sums[1] > 300 && sums[2] > 0, "edges, counted, borders: {sums:?}");
}

#[test]
fn shells_within_shells_and_holes_agree() {
    let light = [-0.5, 3.0, 0.4];
    let mut triangles = ball(12, 20, [0.0; 3], 0.7);
    triangles.extend(ball(10, 12, [0.05, 0.0, 0.0], 0.4));
    triangles.extend(ball(10, 12, [0.2, 0.9, 0.1], 0.3));
    // Every seventh is missing, every eleventh is there twice, every thirteenth is turned.
    let triangles: Vec<Corners> = (0..)
        .zip(triangles)
        .flat_map(|(at, [a, b, c])| {
            let corners = if at % 13 == 0 { [a, c, b] } else { [a, b, c] };
            vec![
                corners;
                if at % 7 == 0 {
                    0
                } else if at % 11 == 0 {
                    2
                } else {
                    1
                }
            ]
        })
        .collect();
    let case = scene(triangles, 300, 4, light, 4, 9);
    let counts = agrees("shells", &SoftCase { samples: lamp(64, light, 0.4, 9), case });
    assert!(counts[0] > 1000, "{counts:?}");
}

#[test]
fn lights_that_cross_casters_and_touch_them_agree() {
    for (centre, radius) in [([0.0, 0.6, 0.0], 0.3), ([0.0, 0.0, 0.0], 0.9), ([1.0, -1.5, 0.3], 0.5)] {
        let case = scene(ball(12, 16, [0.0; 3], 0.6), 200, 2, [0.0, 3.0, 0.0], 4, 4);
        let mut samples = lamp(40, centre, radius, 5);
        samples[3] = case.triangles[7][1];
        agrees("crossing", &SoftCase { samples, case });
    }
}

/// A height field on a grid of halves: view-samples, edges, planes and light samples meet exactly.
#[test]
fn grids_under_lights_on_a_grid_agree() {
    let side = 9;
    let height = |x: usize, z: usize| if (x / 2 + z / 2).is_multiple_of(2) { 0.0 } else { 0.5 };
    let corner = |x: usize, z: usize| [x as f32 * 0.5, height(x, z), z as f32 * 0.5];
    let triangles: Vec<Corners> = (0..side * side)
        .flat_map(|at| {
            let (x, z) = (at % side, at / side);
            let [a, b, c, d] = [corner(x, z), corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)];
            [[a, c, b], [b, c, d]]
        })
        .collect();
    let (mut position, mut triangle) = (Vec::new(), Vec::new());
    for (id, corners) in (0u32..).zip(&triangles) {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            position.extend([a, [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]))]);
            triangle.extend([id, id]);
        }
    }
    let light = [2.0, 2.0, 2.0];
    let mut case = Case {
        casts: vec![1; triangles.len()],
        state: vec![KEPT; position.len()],
        triangles,
        light,
        position,
        triangle,
        faces: Vec::new(),
        side: 3,
    };
    case.look(false, false);
    let samples = (0..49).map(|k| [(k % 7) as f32 * 0.5 + 0.5, 2.0, (k / 7) as f32 * 0.5 + 0.5]).collect();
    agrees("grid", &SoftCase { samples, case });
}

#[test]
fn many_equal_triangles_agree() {
    // Of one facing, of both, and both by turns: none, all and all of their edges balance.
    let card = |at: f32| [[-0.4, at, -0.4], [0.5, at, -0.3], [-0.3, at, 0.5]];
    for (what, is_turned) in [
        ("one facing", (|_| false) as fn(usize) -> bool),
        ("half are turned", |at| at < 2500),
        ("every other is turned", |at| at % 2 == 0),
        ("all but one balance", |at| at < 2501),
    ] {
        let turn = |at: usize| if is_turned(at) { [0, 2, 1] } else { [0, 1, 2] };
        let mut triangles: Vec<Corners> = (0..5000).map(|at| turn(at).map(|corner| card(0.0)[corner])).collect();
        triangles.push(card(0.5));
        let case = scene(triangles, 24, 25, [0.1, 4.0, 0.2], 1, 11);
        let counts = agrees(what, &SoftCase { samples: lamp(6, case.light, 0.5, 11), case });
        assert!(counts[4] == 0, "{what}: {counts:?}");
    }
}

#[test]
fn equal_triangles_that_balance_are_joined() {
    // A ball of which every triangle is there five times, turned the other way twice.
    let ball = ball(16, 24, [0.0; 3], 0.6);
    let copies = |[a, b, c]: Corners| [[a, b, c], [a, c, b], [a, b, c], [b, a, c], [a, b, c]];
    let triangles: Vec<Corners> = ball.into_iter().flat_map(copies).collect();
    let light = [0.4, 4.0, 0.2];
    let case = scene(triangles, 120, 5, light, 4, 2);
    let counts = agrees("copies", &SoftCase { samples: lamp(24, light, 0.4, 2), case });
    assert!(counts[2] > 0, "borders: {counts:?}");
}

#[test]
fn what_is_no_number_agrees() {
    let light = [0.4, 4.0, 0.2];
    let [far, none] = [f32::INFINITY, f32::NAN];
    let strange = [[none; 3], [far; 3], [0.1, none, 0.2], [-far, 0.3, 0.1], [3e38, -3e38, 3e38]];
    let clean = || scene(ball(10, 12, [0.0; 3], 0.6), 90, 3, light, 2, 4);
    // Casters with one strange corner and with three.
    let mut case = clean();
    for (at, strange) in strange.into_iter().enumerate() {
        case.triangles[7 * at][at % 3] = strange;
        case.triangles[7 * at + 100] = [strange; 3];
    }
    let seen = agrees("strange casters", &SoftCase { samples: lamp(40, light, 0.4, 4), case });
    assert!(seen[1] > 10, "{seen:?}");
    // View-samples, among others in one cell and in none, on a triangle and on none.
    let mut case = SoftCase { samples: lamp(40, light, 0.4, 4), case: clean() };
    let expected = case.mask();
    let rows: Vec<usize> = (0..strange.len()).map(|at| 17 * at + 3).collect();
    for (row, strange) in rows.iter().zip(strange) {
        case.case.position[*row] = strange;
    }
    case.case.triangle[rows[0]] = u32::MAX;
    for level in [Level::new(), Level::baseline()] {
        let (found, _) = find(&case, level, |_| {});
        let differing = (0..90).filter(|row| found[2 * row..2 * row + 2] != expected[2 * row..2 * row + 2]);
        assert!(differing.clone().all(|row| rows.contains(&row)), "{:?}", differing.collect::<Vec<_>>());
    }
}

#[test]
fn huge_tiny_and_far_off_scenes_agree() {
    let mut partial = 0;
    for (what, scale, shift) in [
        ("huge", 1e38, 0.0),
        ("large", 1e18, 0.0),
        ("tiny", 1e-38, 0.0),
        ("subnormal", 1e-42, 0.0),
        ("far off", 1.0, 1e6),
        ("mixed", 1e25, 1.0),
    ] {
        let place = |p: [f32; 3]| p.map(|x| 0.7 * x * scale + shift);
        let mut case = scene(ball(10, 12, [0.0; 3], 0.6), 90, 3, [0.4, 3.0, 0.2], 2, 4);
        let samples: Vec<_> = lamp(40, case.light, 0.4, 4).into_iter().map(place).collect();
        case.triangles.iter_mut().for_each(|corners| *corners = corners.map(place));
        case.position.iter_mut().for_each(|position| *position = place(*position));
        case.light = place(case.light);
        case.look(false, false);
        let case = SoftCase { samples, case };
        agrees(what, &case);
        partial += case.mask().iter().filter(|word| **word != 0 && **word != u32::MAX).count();
    }
    assert!(partial > 60, "{partial} words are penumbra");
}

#[test]
fn two_light_samples_are_both_chosen() {
    for seed in 0..12 {
        let case = soft(9000 + seed, 30, 60, 2);
        assert_eq!(mask(&case, 1).0, case.mask(), "seed {seed}");
        let mut choices = super::cpu::choices(&LightBox::clustered(&case.samples));
        choices.sort_unstable();
        assert_eq!(choices, [0, 1]);
    }
}
