use super::PASS;
use crate::shared::area_light_scenes::{SoftCase, add_table, soft};
use crate::shared::hard_scenes::{output, random, run};

fn mask(case: &SoftCase, more: usize, size: u32) -> Vec<u32> {
    let mut inputs = case.inputs(more);
    add_table(&mut inputs, "certain_uncertain", size);
    let (outputs, _) = run(&PASS, &inputs).unwrap();
    output(&outputs, "mask").as_u32().to_vec()
}

#[test]
fn random_scenes_have_no_wrong_bit() {
    for (round, light_sample_count) in [1, 5, 32, 33, 128, 256].into_iter().enumerate() {
        for seed in 0..20 {
            let case = soft(3000 + 100 * round as u64 + seed, 6 + 12 * (seed % 4) as usize, 60, light_sample_count);
            let found = mask(&case, 1 + seed as usize % 5, [32, 34, 64][seed as usize % 3]);
            assert_eq!(found, case.mask(), "{light_sample_count} light samples, seed {seed}");
        }
    }
}

#[test]
fn a_thousand_light_samples_have_no_wrong_bit() {
    for seed in 0..3 {
        let case = soft(9000 + seed, 12, 24, 1000);
        assert_eq!(mask(&case, 2, 32), case.mask(), "seed {seed}");
    }
}

#[test]
fn one_light_sample_gives_the_hard_mask() {
    for seed in 0..40 {
        let hard = random(seed, 20, 200);
        let expected = hard.mask();
        let case = SoftCase { samples: vec![hard.light], case: hard };
        assert_eq!(mask(&case, 1 + seed as usize % 3, 32), expected, "seed {seed}");
    }
}
