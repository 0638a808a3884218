use super::cpu::answer;
use crate::shared::predicate::{Corners, blocks};
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_TRIANGLE};

fn random(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
}

#[test]
fn one_triangle_blocks_what_is_behind_it_and_states_are_kept() {
    let triangles = [[[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]]];
    let lights = [[0.0, 2.0, 0.0], [5.0, 2.0, 0.0]];
    let position = [[0.0, -1.0, 0.0]; 4];
    let own = [NO_TRIANGLE, 0, NO_TRIANGLE, NO_TRIANGLE];
    let states = [KEPT, KEPT, FACING_AWAY, BACKGROUND];
    let masks = answer(&triangles, &[1], &lights, &position, &own, &states, &|_, _| {});
    assert_eq!(masks, [1, 0, u32::MAX, 0]);
    assert_eq!(answer(&triangles, &[0], &lights, &position, &own, &states, &|_, _| {}), [0, 0, u32::MAX, 0]);
    // A triangle beyond the light does not block, nor does an empty scene.
    assert_eq!(answer(&triangles, &[1], &[[0.0, -0.5, 0.0]], &position, &own, &states, &|_, _| {})[0], 0);
    assert_eq!(answer(&[], &[], &lights, &position, &own, &states, &|_, _| {}), [0, 0, u32::MAX, 0]);
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
        let masks = answer(&triangles, &[1; 400], &[light], &position, &own, &vec![KEPT; rows], &|_, _| {});
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
