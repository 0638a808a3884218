use super::PASS;
use crate::shared::area_light_scenes::{SoftCase, add_table, ball, soft};
use crate::shared::hard_scenes::{Inputs, Random, output, random, run};
use shadowgraph_core::array::Array;
use shadowgraph_core::shared::{KEPT, NO_TRIANGLE};

fn mask(inputs: &Inputs) -> Vec<u32> {
    let (outputs, _) = run(&PASS, inputs).unwrap();
    output(&outputs, "mask").as_u32().to_vec()
}

#[test]
fn few_bits_are_wrong_and_fewer_with_a_larger_table() {
    let shares = [32, 128].map(|size| {
        let (mut wrong, mut bits) = (0, 0);
        for seed in 0..20 {
            let case = soft(500 + seed, 20, 60, 128);
            let mut inputs = case.inputs(2);
            add_table(&mut inputs, "angles_distance", size);
            let (found, expected) = (mask(&inputs), case.mask());
            wrong += found.iter().zip(&expected).map(|(a, b)| (a ^ b).count_ones()).sum::<u32>();
            bits += 32 * expected.len();
        }
        f64::from(wrong) / bits as f64
    });
    println!("{shares:?}");
    // Half of these scenes are degenerate, with light samples in the planes of casters: a table does worst there.
    assert!(shares[0] > 0.0 && shares[0] < 0.08 && shares[1] < 0.6 * shares[0], "{shares:?}");
}

/// Triangles around `centre`, five or more, wide enough that no outer edge comes near the light: at least 9 cos(51 degrees) from
/// `centre`.
fn fan(r: &mut Random, centre: [f32; 3], parts: usize) -> Vec<[[f32; 3]; 3]> {
    let rim: Vec<[f32; 3]> = (0..parts)
        .map(|part| {
            let turn = std::f32::consts::TAU * (part as f32 + 0.1 * r.signed()) / parts as f32;
            [centre[0] + 9.0 * turn.cos(), 1.0 + 0.3 * r.signed(), centre[2] + 9.0 * turn.sin()]
        })
        .collect();
    let triangle = |part: usize| {
        let [a, b] = [rim[part], rim[(part + 1) % parts]];
        match part % 3 {
            0 => [centre, a, b],
            1 => [b, centre, a],
            _ => [b, a, centre],
        }
    };
    (0..parts).map(triangle).collect()
}

/// Lit bits below a fan around `centre` that covers the light.
fn leaks(r: &mut Random, centre: [f32; 3], parts: usize) -> u32 {
    let triangles = fan(r, centre, parts);
    let samples: Vec<[f32; 3]> = ball(128).iter().map(|p| [0.5 * p[0], 4.0 + 0.5 * p[1], 0.5 * p[2]]).collect();
    let position: Vec<[f32; 3]> = (0..20).map(|_| [0.3 * r.signed(), -0.5, 0.3 * r.signed()]).collect();
    let count = position.len();
    let casters = triangles.len() as u32;
    let mut inputs: Inputs = vec![
        ("triangles", Array::f32([triangles.len(), 3, 3], bytemuck::cast_slice(&triangles).to_vec())),
        ("caster_state", Array::u32([triangles.len()], vec![1; triangles.len()])),
        ("light_samples", Array::f32([128, 3], bytemuck::cast_slice(&samples).to_vec())),
        ("position", Array::f32([count, 3], bytemuck::cast_slice(&position).to_vec())),
        ("triangle", Array::u32([count], vec![NO_TRIANGLE; count])),
        ("sample_state", Array::u32([count], vec![KEPT; count])),
        ("cell", Array::u32([count], vec![0; count])),
        ("list_offset", Array::u32([2], vec![0, count as u32])),
        ("list_entries", Array::u32([count], (0..count as u32).collect())),
        ("caster_offset", Array::u32([2], vec![0, casters])),
        ("caster_entries", Array::u32([triangles.len()], (0..casters).collect())),
    ];
    add_table(&mut inputs, "angles_distance", 32);
    mask(&inputs).iter().map(|word| word.count_zeros()).sum()
}

#[test]
fn no_light_leaks_between_triangles_that_share_an_edge() {
    let r = &mut Random(77);
    for round in 0..200 {
        // The middle of the fan is to the side of all view-samples' lights; one shared edge at a time runs across them.
        let turn = std::f32::consts::TAU * r.signed();
        let centre = [4.0 * turn.cos(), 1.0, 4.0 * turn.sin()];
        assert_eq!(leaks(r, centre, 5 + round % 5), 0, "round {round}");
    }
}

#[test]
fn where_many_edges_meet_hardly_any_light_leaks() {
    // Edges in their bins no longer meet in one line through a shared corner: a light sample may fall between them.
    let r = &mut Random(78);
    let rounds = 200;
    let lit: u32 = (0..rounds)
        .map(|round| {
            let centre = [0.3 * r.signed(), 1.0, 0.3 * r.signed()];
            leaks(r, centre, 5 + round % 5)
        })
        .sum();
    println!("{lit} of {}", rounds * 20 * 128);
    assert!(f64::from(lit) < 1e-3 * (rounds * 20 * 128) as f64, "{lit}");
}

#[test]
fn one_light_sample_gives_the_hard_mask_but_for_rounding() {
    let (mut wrong, mut count) = (0, 0);
    for seed in 0..40 {
        let hard = random(seed, 20, 200);
        let expected = hard.mask();
        let case = SoftCase { samples: vec![hard.light], case: hard };
        let mut inputs = case.inputs(2);
        add_table(&mut inputs, "angles_distance", 32);
        wrong += mask(&inputs).iter().zip(&expected).filter(|(a, b)| a != b).count();
        count += expected.len();
    }
    // Only values below their own rounding are decided by their sign alone.
    assert!(wrong * 200 <= count, "{wrong} of {count}");
}

#[test]
fn no_table_or_another_is_refused() {
    let case = soft(1, 4, 10, 40);
    let mut inputs = case.inputs(1);
    let problem = run(&PASS, &inputs).unwrap_err().to_string();
    assert!(problem.contains("lu_table/angles_distance") && problem.contains("nothing connected"), "{problem}");
    add_table(&mut inputs, "certain_uncertain", 32);
    assert!(run(&PASS, &inputs).unwrap_err().to_string().contains("lu_table/angles_distance"));
}
