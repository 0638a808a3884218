use super::PASS;
use crate::shared::area_light_scenes::{SoftCase, soft, soft_planar};
use crate::shared::hard_scenes::{output, random, run};

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
