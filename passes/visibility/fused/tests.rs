use super::PASS;
use crate::shared::hard_scenes::{Case, output, random, run};

fn wrong(case: &Case) -> usize {
    let (outputs, _) = run(&PASS, &case.inputs()).unwrap();
    let mask = output(&outputs, "mask");
    assert_eq!(mask.shape(), [case.position.len(), 1]);
    case.mask().iter().zip(mask.as_u32()).filter(|(a, b)| a != b).count()
}

#[test]
fn random_scenes_have_no_wrong_bit() {
    let mut blocked = 0;
    for seed in 0..400 {
        let case = random(seed, 6 + 12 * (seed % 4) as usize, 300);
        assert_eq!(wrong(&case), 0, "seed {seed}");
        blocked += case.mask().iter().filter(|word| **word == 1).count();
    }
    // Far from none and far from all: the scenes say something.
    assert!((20_000..80_000).contains(&blocked), "{blocked}");
}
