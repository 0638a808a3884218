use super::PASS;
use crate::shared::area_light_scenes::{SoftCase, soft};
use crate::shared::hard_scenes::{output, random, run};

fn mask(case: &SoftCase, more: usize) -> Vec<u32> {
    let (outputs, _) = run(&PASS, &case.inputs(more)).unwrap();
    output(&outputs, "mask").as_u32().to_vec()
}

#[test]
fn random_scenes_have_no_wrong_bit() {
    let mut partial = 0;
    for (round, light_sample_count) in [1, 5, 32, 33, 128, 256].into_iter().enumerate() {
        for seed in 0..24 {
            let case = soft(100 * round as u64 + seed, 6 + 12 * (seed % 4) as usize, 60, light_sample_count);
            let expected = case.mask();
            assert_eq!(mask(&case, 1 + seed as usize % 5), expected, "{light_sample_count} light samples, seed {seed}");
            partial += expected.iter().filter(|word| **word != 0 && **word != u32::MAX).count();
        }
    }
    assert!(partial > 3000, "only {partial} words are penumbra");
}

#[test]
fn a_thousand_light_samples_have_no_wrong_bit() {
    for seed in 0..4 {
        let case = soft(7000 + seed, 12, 24, 1000);
        assert_eq!(mask(&case, 2), case.mask(), "seed {seed}");
    }
}

#[test]
fn one_light_sample_gives_the_hard_mask() {
    for seed in 0..60 {
        let hard = random(seed, 20, 200);
        let expected = hard.mask();
        let case = SoftCase { samples: vec![hard.light], case: hard };
        assert_eq!(mask(&case, 1 + seed as usize % 3), expected, "seed {seed}");
    }
}

#[test]
fn only_listed_casters_count() {
    let case = soft(3, 20, 200, 40);
    let mut inputs = case.inputs(1);
    for (port, array) in &mut inputs {
        if *port == "caster_offset" {
            array.words_mut().fill(0);
        }
    }
    let (outputs, counts) = run(&PASS, &inputs).unwrap();
    let lit = |row: &[u32]| row == [0, 0] || row == [u32::MAX; 2];
    assert!(output(&outputs, "mask").as_u32().chunks_exact(2).all(lit) && counts[1] == 0);
}

#[test]
fn no_light_sample_gives_empty_masks() {
    let case = soft(5, 8, 20, 0);
    assert!(mask(&case, 1).is_empty());
}

#[test]
fn a_view_sample_in_no_cell_meets_every_caster() {
    let case = soft(11, 20, 100, 33);
    let mut inputs = case.inputs(7);
    for (port, array) in &mut inputs {
        match *port {
            "cell" => array.words_mut().fill(u32::MAX),
            "list_offset" | "caster_offset" => array.words_mut().fill(0),
            _ => {}
        }
    }
    let (outputs, _) = run(&PASS, &inputs).unwrap();
    assert_eq!(output(&outputs, "mask").as_u32(), case.mask());
}
