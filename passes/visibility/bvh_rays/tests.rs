use super::cpu::Scene;
use crate::shared::bvh::Bvh;
use crate::shared::predicate::{Corners, blocks};
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_TRIANGLE};

fn random(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
}

fn answer(
    triangles: &[Corners],
    caster_state: &[u32],
    light_samples: &[[f32; 3]],
    position: &[[f32; 3]],
    triangle: &[u32],
    sample_state: &[u32],
) -> Vec<u32> {
    let bvh = Bvh::build(triangles, |id| caster_state[id] == 1);
    let (nodes, order) = (&bvh.threaded(), bvh.order());
    super::cpu::answer(Scene { triangles, nodes, order, light_samples, position, triangle, sample_state }, &|_, _| {})
}

#[test]
fn one_triangle_blocks_what_is_behind_it_and_states_are_kept() {
    let triangles = [[[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]]];
    let lights = [[0.0, 2.0, 0.0], [5.0, 2.0, 0.0]];
    let position = [[0.0, -1.0, 0.0]; 4];
    let own = [NO_TRIANGLE, 0, NO_TRIANGLE, NO_TRIANGLE];
    let states = [KEPT, KEPT, FACING_AWAY, BACKGROUND];
    let masks = answer(&triangles, &[1], &lights, &position, &own, &states);
    assert_eq!(masks, [1, 0, u32::MAX, 0]);
    assert_eq!(answer(&triangles, &[0], &lights, &position, &own, &states), [0, 0, u32::MAX, 0]);
    // A triangle beyond the light does not block, nor does an empty scene.
    assert_eq!(answer(&triangles, &[1], &[[0.0, -0.5, 0.0]], &position, &own, &states)[0], 0);
    assert_eq!(answer(&[], &[], &lights, &position, &own, &states), [0, 0, u32::MAX, 0]);
}

#[test]
fn random_soup_stays_within_the_contract_at_every_scale() {
    for scale in [1.0, 1e-30, 1e37, 1e-6] {
        let seed = &mut 5;
        let mut point = |by: f32, around: [f32; 3]| [0, 1, 2].map(|k| around[k] + by * random(seed));
        let triangles: Vec<Corners> = (0..400)
            .map(|_| {
                let centre = point(1.0, [0.0; 3]);
                [0; 3].map(|_| point(0.3, centre).map(|x| x * scale))
            })
            .collect();
        let light = [0.3f32, 2.0, 0.1].map(|x| x * scale);
        let rows = 5_000;
        let own: Vec<u32> = (0..rows as u32).map(|row| row % 400).collect();
        let position: Vec<[f32; 3]> = own
            .iter()
            .map(|&id| {
                let [a, b, c] = triangles[id as usize];
                let (s, t) = (point(0.25, [0.25; 3])[0], point(0.25, [0.25; 3])[0]);
                [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
            })
            .collect();
        let masks = answer(&triangles, &[1; 400], &[light], &position, &own, &vec![KEPT; rows]);
        let wrong = (0..rows)
            .filter(|&row| {
                let own_corners = &triangles[own[row] as usize];
                let truth = (0u32..)
                    .zip(&triangles)
                    .any(|(id, caster)| id != own[row] && blocks(position[row], Some(own_corners), caster, light));
                (masks[row] == 1) != truth
            })
            .count();
        let blocked = masks.iter().filter(|mask| **mask == 1).count();
        assert!(blocked > rows / 10 && blocked < rows * 9 / 10, "{blocked} blocked at scale {scale}");
        assert!(wrong * 1_000 <= rows, "{wrong} of {rows} wrong at scale {scale}");
    }
}

#[test]
fn collinear_slivers_cast_next_to_nothing() {
    // Collinear but for rounding, all between the light and a grid of view-samples.
    let seed = &mut 6;
    let triangles: Vec<Corners> = (0..60)
        .map(|_| {
            let (a, b) = ([0; 3].map(|_| random(seed)), [0; 3].map(|_| random(seed)));
            [a, b, [0, 1, 2].map(|k| (a[k] + b[k]) / 2.0)]
        })
        .collect();
    let grid = |k: usize| [(k % 50) as f32 / 25.0 - 1.0, -1.5, (k / 50) as f32 / 25.0 - 1.0];
    let position: Vec<[f32; 3]> = (0..2_500).map(grid).collect();
    let (own, states) = (vec![NO_TRIANGLE; 2_500], vec![KEPT; 2_500]);
    let masks = answer(&triangles, &[1; 60], &[[0.1, 3.0, 0.2]], &position, &own, &states);
    assert!(masks.iter().sum::<u32>() <= 2, "{}", masks.iter().sum::<u32>());
}

#[test]
fn a_sheet_of_many_triangles_has_no_leak_along_its_edges() {
    // A grid of thirds, which f32 rounds, below a light whose rays pass its corners and edges.
    let corner = |x: usize, z: usize| [x as f32 / 3.0, 0.1 * ((x + z) % 3) as f32, z as f32 / 3.0];
    let triangles: Vec<Corners> = (0..100)
        .flat_map(|cell| {
            let (x, z) = (cell % 10, cell / 10);
            let [a, b, c, d] = [corner(x, z), corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)];
            [[a, c, b], [b, c, d]]
        })
        .collect();
    let light = [1.7f32, 5.0, 1.3];
    // Twice as far from the light as points of inner edges: their middles, and their ends.
    let beyond = |p: [f32; 3], q: [f32; 3]| [0, 1, 2].map(|k| p[k] + q[k] - light[k]);
    let inner = || (1..9).flat_map(|x| (1..9).map(move |z| (x, z)));
    let middles = inner().flat_map(|(x, z)| [(x + 1, z), (x, z + 1), (x + 1, z - 1)].map(|(i, j)| (x, z, i, j)));
    let middles: Vec<_> = middles.map(|(x, z, i, j)| beyond(corner(x, z), corner(i, j))).collect();
    let ends: Vec<_> = inner().map(|(x, z)| beyond(corner(x, z), corner(x, z))).collect();
    let leaks = |position: &[[f32; 3]]| {
        let (own, states) = (vec![NO_TRIANGLE; position.len()], vec![KEPT; position.len()]);
        let masks = answer(&triangles, &[1; 200], &[light], position, &own, &states);
        masks.iter().filter(|mask| **mask == 0).count()
    };
    assert_eq!(leaks(&middles), 0);
    assert!(leaks(&ends) <= 3, "{} leaks at corners", leaks(&ends));
}

#[test]
fn a_packet_answers_as_its_rays_do_one_by_one() {
    let seed = &mut 8;
    let triangles: Vec<Corners> = (0..300)
        .map(|_| {
            let centre = [0; 3].map(|_| random(seed));
            [0; 3].map(|_| [0, 1, 2].map(|k| centre[k] + 0.3 * random(seed)))
        })
        .collect();
    // Two packets, the second not full; wide enough that some rays hit and some miss.
    let lights: Vec<[f32; 3]> =
        (0..300).map(|_| [0.5 * random(seed), 2.5 + 0.5 * random(seed), 0.5 * random(seed)]).collect();
    let position: Vec<[f32; 3]> = (0..400).map(|_| [random(seed), -1.0 + 0.3 * random(seed), random(seed)]).collect();
    let (own, states) = (vec![NO_TRIANGLE; 400], vec![KEPT; 400]);
    let casters = vec![1; 300];
    let together = answer(&triangles, &casters, &lights, &position, &own, &states);
    let mut partly = 0;
    for (sample, light) in lights.iter().enumerate() {
        let alone = answer(&triangles, &casters, &[*light], &position, &own, &states);
        for (row, mask) in together.chunks_exact(10).enumerate() {
            assert_eq!(mask[sample / 32] >> (sample % 32) & 1, alone[row], "view-sample {row}, light sample {sample}");
        }
    }
    for mask in together.chunks_exact(10) {
        let blocked: u32 = mask.iter().map(|word| word.count_ones()).sum();
        partly += usize::from(blocked > 0 && blocked < 300);
        assert_eq!(mask[9] >> 12, 0, "bits past the light samples");
    }
    assert!(partly > 40, "{partly}");
}

#[test]
fn faces_that_lie_in_one_another_cast_no_shadow_on_one_another() {
    let face = [[-3.0, 0.3, -1.0], [1.0, 0.7, -2.0], [0.0, 0.1, 3.1]];
    let turned = [face[1], face[2], face[0]];
    let within = [0, 1, 2].map(|k| [0, 1, 2].map(|j| 0.25 * face[k][j] + 0.75 * face[(k + 1) % 3][j]));
    let triangles = [face, turned, within, [[-3.0, 2.0, -3.0], [3.0, 2.0, -3.0], [0.0, 2.0, 3.0]]];
    let at =
        |s: f32, t: f32| [0, 1, 2].map(|k| face[0][k] + s * (face[1][k] - face[0][k]) + t * (face[2][k] - face[0][k]));
    let position = [at(0.33, 0.33), at(0.4, 0.31)];
    let lights = [[0.0, 9.0, 0.0], [80.0, 9.0, 0.0]];
    let masks = |casters: &[u32]| answer(&triangles, casters, &lights, &position, &[0, 1], &[KEPT; 2]);
    assert_eq!(masks(&[1, 1, 1, 0]), [0, 0]);
    assert_eq!(masks(&[1, 1, 1, 1]), [1, 1]);
}

#[test]
fn the_scale_of_a_packet_is_a_power_of_two_for_every_float() {
    use super::packet::unit_scale;
    for largest in [1e-45f32, 1e-38, 1.0, 1.5, 3.0e38] {
        let scale = unit_scale(largest);
        assert!(scale > 0.0 && scale.is_normal() && scale.log2().fract() == 0.0, "{largest}");
    }
    assert_eq!([unit_scale(1.0), unit_scale(3.0), unit_scale(0.3)], [1.0, 0.5, 4.0]);
}

#[test]
fn rays_of_a_cone_that_ends_straight_up_are_not_lost() {
    // The light's box ends where the view-sample is, on one axis or both, from either side.
    let sheet: Vec<Corners> = (0..64)
        .map(|id| {
            let (x, z) = ((id % 8) as f32 - 4.0, (id / 8) as f32 - 4.0);
            [[x, 1.0, z], [x + 2.5, 1.0, z], [x, 1.0, z + 2.5]]
        })
        .collect();
    let casts = vec![1; sheet.len()];
    for (x, z) in [(-0.5f32, -0.25f32), (0.5, 0.25), (-0.5, 0.0), (0.0, 0.5), (-1e-40, -1e-40), (1e-40, 0.5)] {
        let lights = [[0.0, 2.0, 0.0], [x, 2.0, z], [x, 2.0, 0.0], [0.0, 2.0, z]];
        let answer = |lights: &[[f32; 3]]| answer(&sheet, &casts, lights, &[[0.0; 3]], &[NO_TRIANGLE], &[KEPT])[0];
        let alone: u32 = lights.iter().enumerate().map(|(bit, light)| answer(&[*light]) << bit).sum();
        assert_eq!((answer(&lights), alone), (0b1111, 0b1111), "{x} {z}");
    }
}
