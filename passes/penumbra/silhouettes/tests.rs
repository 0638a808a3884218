use super::PASS;
use super::cpu::{BOUNDS, SHAPE};
use crate::shared::area_light_scenes::{SoftCase, add_table, disc, soft};
use crate::shared::contact::contact_band;
use crate::shared::footprint::{Grid, reach_among};
use crate::shared::hard_scenes::{Case, Inputs, Random, output, random, run};
use crate::shared::influence::face_lights;
use crate::shared::light_fit;
use crate::shared::pair_walk::{Side, mark_cells};
use crate::shared::predicate::Corners;
use crate::shared::pyramid::LightSpace;
use crate::shared::soft_scenes::{self, LIGHTS};
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::shared::{KEPT, NO_CELL};

fn pass(stage: &str, name: &str) -> &'static Pass {
    crate::catalogue().pass(stage, name).expect("a pass")
}

/// Inputs of the pass and of visibility, `across` among them.
fn inputs(case: &SoftCase) -> Inputs {
    let mut inputs = case.inputs(3);
    let (outputs, _) = run(pass("adjacency", "half_edges"), &inputs).unwrap();
    inputs.extend(outputs);
    inputs
}

fn states(inputs: &Inputs) -> Vec<u32> {
    output(&run(&PASS, inputs).unwrap().0, "penumbra_state").as_u32().to_vec()
}

/// Rows of state 0 at which some light samples are blocked and others not, outside the contact band; and in the band.
fn parted(case: &SoftCase, states: &[u32]) -> [Vec<usize>; 2] {
    let words = case.samples.len().div_ceil(32);
    let mask = case.mask();
    let is_parted = |row: &usize| {
        let mask = &mask[row * words..(row + 1) * words];
        let count = mask.iter().map(|word| word.count_ones()).sum::<u32>() as usize;
        case.case.state[*row] == KEPT && states[*row] == 0 && count != 0 && count != case.samples.len()
    };
    let rows: Vec<usize> = (0..states.len()).filter(is_parted).collect();
    let scene = &case.case;
    let band =
        contact_band(&scene.triangles, &scene.casts, &case.samples, &scene.position, &scene.triangle, &rows, 4.0);
    [false, true]
        .map(|in_band| rows.iter().zip(&band).filter(|(_, band)| **band == in_band).map(|(row, _)| *row).collect())
}

/// A ball of 8 x 6 quads, closed and outwards.
fn ball(centre: Vec3, radius: f32) -> Vec<Corners> {
    let (round, high) = (8usize, 6usize);
    let at = |i: usize, j: usize| {
        let (turn, lift) =
            (i as f32 / round as f32 * std::f32::consts::TAU, j as f32 / high as f32 * std::f32::consts::PI);
        // Poles are one point each.
        let wide = if j == 0 || j == high { 0.0 } else { lift.sin() };
        let turn = if wide == 0.0 || i == round { 0.0 } else { turn };
        (centre + radius * Vec3::new(wide * turn.cos(), lift.cos(), wide * turn.sin())).to_array()
    };
    let mut triangles = Vec::new();
    for i in 0..round {
        for j in 0..high {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
    }
    triangles
}

/// A closed box, its bottom too.
fn block(low: Vec3, size: Vec3, turn: f32) -> Vec<Corners> {
    let corner = |k: usize| {
        let at = Vec3::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32) * size;
        let (sin, cos) = turn.sin_cos();
        [low.x + cos * at.x - sin * at.z, low.y + at.y, low.z + sin * at.x + cos * at.z]
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|quad| quad.map(corner)).collect()
}

/// A point of a triangle near the shadow of some edge, and that triangle.
fn behind_an_edge(triangles: &[Corners], samples: &[[f32; 3]], r: &mut Random) -> Option<([f32; 3], usize)> {
    let corners = triangles[32.min(triangles.len() - 1) + r.below(triangles.len().saturating_sub(32).max(1))];
    let k = r.below(3);
    let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|corner| Vec3::from(corner).as_dvec3());
    let from = Vec3::from(samples[r.below(samples.len())]).as_dvec3();
    let on = a + f64::from(0.5 + 0.5 * r.signed()) * (b - a);
    let along = on - from + 0.01 * a.distance(b) * Vec3::from(r.point()).as_dvec3();
    // The nearest triangle beyond the edge.
    let hit = |(index, corners): (usize, &Corners)| {
        let [a, b, c] = corners.map(|corner| Vec3::from(corner).as_dvec3());
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - from) / normal.dot(along);
        let at = from + t * along;
        let is_inside = [(a, b), (b, c), (c, a)].iter().all(|(p, q)| (*q - *p).cross(at - *p).dot(normal) >= 0.0);
        (t > 1.02 && t.is_finite() && is_inside).then_some((t, at.as_vec3().to_array(), index))
    };
    let nearest = triangles.iter().enumerate().filter_map(hit).min_by(|one, other| one.0.total_cmp(&other.0));
    nearest.map(|(_, position, own)| (position, own))
}

/// Closed meshes that stand on a floor, touch it, hang over it or stand in one another; some with a triangle taken out, doubled, turned
/// over, not casting, or a needle added. View-samples all over them.
fn closed(seed: u64, light_sample_count: usize) -> SoftCase {
    let r = &mut Random(seed);
    let mut case: Case = random(seed, 1, 0);
    let scale = [1.0, 0.01, 300.0][r.below(3)];
    let offset = if r.below(3) == 0 { Vec3::new(1e3, -2e2, 5e2) * scale } else { Vec3::ZERO };
    let mut triangles: Vec<Corners> = Vec::new();
    let floor = |x: f32, z: f32| [x, 0.0, z];
    for cell in 0..16 {
        let (x, z) = ((cell % 4) as f32 - 2.0, (cell / 4) as f32 - 2.0);
        let [a, b, c, d] = [floor(x, z), floor(x, z + 1.0), floor(x + 1.0, z + 1.0), floor(x + 1.0, z)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    for _ in 0..1 + r.below(3) {
        let at = 1.5 * Vec3::new(r.signed(), 0.0, r.signed());
        let size = 0.3 + 0.3 * r.signed().abs();
        let lift = [0.0, 0.0, 0.3, -0.1][r.below(4)];
        triangles.extend(if r.below(2) == 0 {
            ball(at + Vec3::Y * (size + lift), size)
        } else {
            block(at + Vec3::Y * lift, Vec3::new(size, 0.8 * size, 1.2 * size), [0.0, 0.4][r.below(2)])
        });
    }
    if r.below(3) == 0 {
        // A tilted stand: coordinates that rounding leaves off every plane.
        let (sin, cos) = 0.3f32.sin_cos();
        let tilt = |[x, y, z]: [f32; 3]| [cos * x - sin * y, sin * x + cos * y, z];
        triangles.iter_mut().for_each(|corners| *corners = corners.map(tilt));
    }
    for _ in 0..r.below(3) {
        let at = r.below(triangles.len());
        match r.below(4) {
            0 => {
                triangles.swap_remove(at);
            }
            1 => triangles.push(triangles[at]),
            2 => triangles[at].swap(0, 1),
            _ => {
                let [a, b, _] = triangles[at];
                triangles.push([a, b, [0, 1, 2].map(|k| 0.5 * a[k] + 0.5 * b[k])]);
            }
        }
    }
    let place = |p: [f32; 3]| (scale * Vec3::from(p) + offset).to_array();
    case.triangles = triangles.into_iter().map(|corners| corners.map(place)).collect();
    case.casts = case.triangles.iter().map(|_| u32::from(r.below(60) > 0)).collect();
    let radius = [0.05, 0.1, 0.2, 1.0][r.below(4)];
    let aside = [0.7, 4.0, 4.0][r.below(3)];
    let centre = Vec3::new(aside * r.signed(), [2.5, 4.0, 1.5][r.below(3)], aside * r.signed());
    let normal = Vec3::new(0.3 * r.signed(), 1.0, 0.3 * r.signed()).to_array();
    let is_ball = r.below(2) == 0;
    let samples: Vec<[f32; 3]> = disc(r, centre.to_array(), normal, radius, light_sample_count);
    let lift = |p: [f32; 3]| [p[0], p[1] + if is_ball { 0.5 * radius * (7.0 * p[0]).sin() } else { 0.0 }, p[2]];
    let samples: Vec<[f32; 3]> = samples.into_iter().map(lift).map(place).collect();
    case.light = light_fit::origin(&samples).to_array();
    (case.position, case.triangle, case.state) = (Vec::new(), Vec::new(), Vec::new());
    for row in 0..150 {
        let own =
            if r.below(2) == 0 { r.below(32) } else { r.below(case.triangles.len()) }.min(case.triangles.len() - 1);
        if row % 2 == 0
            && let Some((position, own)) = behind_an_edge(&case.triangles, &samples, r)
        {
            case.position.push(position);
            case.triangle.push(own as u32);
            case.state.push(KEPT);
            continue;
        }
        let [a, b, c] = case.triangles[own].map(Vec3::from);
        let (mut s, mut t) = (0.5 + 0.5 * r.signed(), 0.5 + 0.5 * r.signed());
        match r.below(12) {
            0 => t = 0.0,
            1 => t = 1.0 - s,
            2 => (s, t) = (0.0, 0.0),
            3 => t = 1e-6,
            _ if s + t > 1.0 => (s, t) = (1.0 - s, 1.0 - t),
            _ => {}
        }
        case.position.push((a + s * (b - a) + t * (c - a)).to_array());
        case.triangle.push(own as u32);
        case.state.push(KEPT);
    }
    case.side = [4, 16, 64][r.below(3)];
    case.look(false, r.below(4) == 0);
    SoftCase { case, samples }
}

#[test]
fn state_zero_means_one_answer_for_every_light_sample() {
    let (mut zero, mut kept, mut close) = (0, 0, 0);
    for seed in 0..300 {
        let case = closed(seed, 40);
        let states = states(&inputs(&case));
        let [wrong, in_band] = parted(&case, &states);
        assert!(wrong.is_empty(), "seed {seed}: view-samples {wrong:?}");
        close += in_band.len();
        zero += states.iter().zip(&case.case.state).filter(|(a, b)| (**a, **b) == (0, KEPT)).count();
        kept += case.case.state.iter().filter(|state| **state == KEPT).count();
    }
    println!("{zero} of {kept} view-samples have one answer; {close} more in the contact band differ");
    assert!(8 * zero > kept && 1000 * close < kept, "{zero} of {kept}, {close}");
}

#[test]
fn random_triangles_are_restricted_exactly_too() {
    let (mut zero, mut close) = (0, 0);
    for seed in 0..400 {
        let case = soft(500 + seed, 3 + 6 * (seed % 5) as usize, 60, 33);
        let states = states(&inputs(&case));
        let [wrong, in_band] = parted(&case, &states);
        assert!(wrong.is_empty(), "seed {seed}: view-samples {wrong:?}");
        close += in_band.len();
        zero += states.iter().filter(|state| **state == 0).count();
    }
    println!("{zero} view-samples have one answer; {close} more in the contact band differ");
    assert!(zero > 2000 && close < 20, "{zero} {close}");
}

/// States when edges of `across` for which `is_planted` says so are taken for inner ones: their own triangle is said to be across.
fn planted(case: &SoftCase, is_planted: impl Fn(usize) -> bool) -> Vec<u32> {
    let mut inputs = inputs(case);
    for (port, array) in &mut inputs {
        if *port == "across" {
            for (at, word) in array.words_mut().iter_mut().enumerate().filter(|(at, _)| is_planted(*at)) {
                *word = (at / 3) as u32;
            }
        }
    }
    states(&inputs)
}

#[test]
fn silhouettes_that_are_taken_for_inner_edges_are_missed() {
    let wrong = |seed| {
        let case = closed(seed, 40);
        parted(&case, &planted(&case, |_| true))[0].len()
    };
    let wrong = (0..40).map(wrong).sum::<usize>();
    assert!(wrong > 200, "{wrong}");
}

#[test]
fn one_edge_of_a_card_that_is_taken_for_an_inner_one_is_missed() {
    let mut case = closed(7, 40);
    let scene = &mut case.case;
    let flat = |x: f32, y: f32, z: f32| [x, y, z];
    let quad = |s: f32, y: f32| {
        let [a, b, c, d] = [flat(-s, y, -s), flat(-s, y, s), flat(s, y, s), flat(s, y, -s)];
        [[a, b, c], [a, c, d]]
    };
    scene.triangles = [quad(3.0, 0.0), quad(1.0, 1.0)].concat();
    scene.casts = vec![1; 4];
    case.samples = disc(&mut Random(3), [0.0, 4.0, 0.0], [0.0, 1.0, 0.0], 0.5, 40);
    scene.light = light_fit::origin(&case.samples).to_array();
    let at = |k: usize| flat((k % 20) as f32 * 0.29 - 2.755, 0.0, (k / 20) as f32 * 0.29 - 2.755);
    scene.position = (0..400).map(at).collect();
    scene.triangle = scene.position.iter().map(|[x, _, z]| u32::from(x > z)).collect();
    scene.state = vec![KEPT; 400];
    scene.side = 32;
    scene.look(false, false);
    assert_eq!(parted(&case, &planted(&case, |_| false)).concat(), []);
    let zero = planted(&case, |_| false).iter().filter(|state| **state == 0).count();
    assert!(zero > 150, "{zero} of 400");
    // Corner 0 to 1, and 1 to 2, of the card's first triangle.
    for edge in [6, 7] {
        let wrong = parted(&case, &planted(&case, |at| at == edge))[0].len();
        assert!(wrong > 3, "{wrong} view-samples are wrong without edge {edge}");
    }
}

#[test]
fn masks_with_states_are_those_without() {
    for seed in 0..80 {
        let case = closed(1000 + seed, [1, 32, 70][seed as usize % 3]);
        let mut inputs = inputs(&case);
        add_table(&mut inputs, "certain_uncertain", 16);
        let states = states(&inputs);
        let in_band = parted(&case, &states)[1].clone();
        let with_states = [&inputs[..], &[("penumbra_state", Array::u32([states.len()], states))]].concat();
        for name in ["half_planes", "lu_certain"] {
            let pass = pass("visibility", name);
            let ((whole, before), (restricted, after)) =
                (run(pass, &inputs).unwrap(), run(pass, &with_states).unwrap());
            let words = case.samples.len().div_ceil(32);
            let [whole, restricted] =
                [&whole, &restricted].map(|outputs| output(outputs, "mask").as_u32().chunks(words));
            for (row, (whole, restricted)) in whole.zip(restricted).enumerate() {
                assert!(whole == restricted || in_band.contains(&row), "{name}, seed {seed}, view-sample {row}");
            }
            let cut = pass.counter_index("cut_pairs");
            assert!(after[cut] <= before[cut], "{name}: more pairs are cut");
        }
    }
}

#[test]
fn a_state_of_zero_is_believed() {
    // All view-samples take the answer of one light sample.
    let mut differ = 0;
    for seed in 0..20 {
        let case = closed(seed, 40);
        let mut inputs = inputs(&case);
        inputs.push(("penumbra_state", Array::u32([150], vec![0; 150])));
        let (outputs, _) = run(pass("visibility", "half_planes"), &inputs).unwrap();
        let cell = output(&inputs, "cell").as_u32();
        for (row, mask) in output(&outputs, "mask").as_u32().chunks(2).enumerate() {
            let is_whole = mask == [0, 0] || mask == [u32::MAX, 0xff] || mask == [u32::MAX; 2];
            assert!(is_whole || cell[row] == NO_CELL);
        }
        differ += output(&outputs, "mask").as_u32().iter().zip(case.mask()).filter(|(a, b)| **a != *b).count();
    }
    assert!(differ > 100, "{differ}");
}

/// View-samples exactly behind points of an edge, as seen from points of the light.
fn behind_edges(seed: u64, kind: &str) -> (soft_scenes::Soft, Vec<(usize, Corners)>) {
    let mut soft = soft_scenes::soft(seed, kind, 12, 60);
    let r = &mut Random(seed ^ 0xed6e);
    let case = &mut soft.case;
    let mut behind = Vec::new();
    for row in 0..case.position.len() {
        let corners = case.triangles[r.below(case.triangles.len())];
        let k = r.below(3);
        let [a, b] = [corners[k], corners[(k + 1) % 3]];
        let mut mix = |p: [f32; 3], q: [f32; 3], ends: bool| {
            let t = if ends && r.below(3) == 0 { r.below(2) as f64 } else { f64::from(0.5 + 0.5 * r.signed()) };
            [0, 1, 2].map(|k| f64::from(p[k]) + t * (f64::from(q[k]) - f64::from(p[k])))
        };
        let on = mix(a, b, true);
        let light: Vec<[f32; 3]> = (0..2).map(|step| soft.light[(7 * row + step) % soft.light.len()]).collect();
        let from = mix(light[0], light[1], true);
        let beyond = [0.0, 1e-3, 0.5, 4.0][row % 4];
        let exact = [0, 1, 2].map(|k| on[k] + beyond * (on[k] - from[k]));
        case.position[row] = exact.map(|x| x as f32);
        case.state[row] = KEPT;
        // Far from the scene's origin rounding moves a view-sample off the segment.
        let moved = (0..3).map(|k| (exact[k] - f64::from(case.position[row][k])).abs()).sum::<f64>();
        let away = (0..3).map(|k| (exact[k] - f64::from(case.light[k])).abs()).sum::<f64>();
        if moved < 3e-7 * away {
            behind.push((row, [a, b, b]));
        }
    }
    let six = case.faces.len() == 6;
    case.look(six, false);
    (soft, behind)
}

#[test]
fn the_region_of_an_edge_holds_all_that_is_behind_it() {
    let (mut asked, mut touched, mut all) = (0, 0, 0);
    for (index, kind) in LIGHTS.iter().enumerate() {
        for seed in 0..40 {
            let (soft, behind) = behind_edges(700 * index as u64 + seed, kind);
            let inputs = soft.inputs();
            let cell = output(&inputs, "cell").as_u32();
            let [length, far] = ["list_length", "list_far"].map(|port| output(&inputs, port));
            let (case, side) = (&soft.case, soft.case.side);
            let of = |index: usize| {
                let face = case.faces[index];
                let grid = Grid::new(&face, side, reach_among(&case.faces, index));
                Side { face, space: LightSpace::new(&face), grid }
            };
            let sides: Vec<Side> = (0..case.faces.len()).map(of).collect();
            let lights = face_lights(&sides, &soft.light, SHAPE, BOUNDS);
            for (row, edge) in behind.iter().filter(|(row, _)| cell[*row] != NO_CELL) {
                let region = |face: usize, edge: &Corners| {
                    lights[face].region(&sides[face].space.corners(edge), &sides[face].grid)
                };
                let marks = mark_cells(&[*edge], &sides, length.as_u32(), far.as_f32(), region);
                assert!(marks[cell[*row] as usize] != 0, "{kind} {seed}: view-sample {row}");
                asked += 1;
                touched += marks.iter().sum::<u32>() as usize;
                all += length.as_u32().iter().filter(|length| **length > 0).count();
            }
        }
    }
    println!("{asked} view-samples behind edges; a region touches {touched} of {all} cells");
    assert!(asked > 5000 && 2 * touched < all, "{asked} {touched} {all}");
}

#[test]
fn bounds_of_whole_side_are_those_of_pyramids() {
    let [side, pyramid] = [include_str!("whole_side.wgsl"), include_str!("../../shared/pyramid.wgsl")];
    let value = |text: &str, name: &str| {
        let found = text.lines().find_map(|line| line.strip_prefix(&format!("const {name}: f32 = ")));
        found.map(|value| value.trim_end_matches(';').to_string()).expect("a constant")
    };
    assert_eq!(value(side, "PLANE_ROUNDING"), value(pyramid, "ROUNDING"));
    // The function that they bound.
    for line in
        ["let left = {p}.yzx * {q}.zxy;", "let right = {p}.zxy * {q}.yzx;", "let size = abs(left) + abs(right);"]
    {
        let of = |p: &str, q: &str| line.replace("{p}", p).replace("{q}", q);
        assert!(side.contains(&of("p", "q")) && pyramid.contains(&of("a", "b")), "{line}");
    }
    let bound = "ROUNDING * max(size.x, max(size.y, size.z))";
    assert!(side.contains(bound) && pyramid.contains(bound));
}

#[test]
fn nothing_to_look_at_has_state_zero_and_no_count() {
    for empty in ["triangles", "light_samples", "position"] {
        let mut case = closed(3, 40);
        match empty {
            "triangles" => (case.case.triangles, case.case.casts) = (Vec::new(), Vec::new()),
            "light_samples" => case.samples.clear(),
            _ => (case.case.position, case.case.triangle, case.case.state) = (Vec::new(), Vec::new(), Vec::new()),
        }
        let (outputs, counts) = run(&PASS, &inputs(&case)).unwrap();
        let states = output(&outputs, "penumbra_state").as_u32();
        assert_eq!(states, vec![0; case.case.position.len()], "{empty}");
        assert!(counts.iter().all(|count| *count == 0), "{empty}: {counts:?}");
    }
}
