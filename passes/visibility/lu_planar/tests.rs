use super::PASS;
use crate::shared::area_light_scenes::{add_table, soft_planar};
use crate::shared::hard_scenes::{output, run};

#[test]
fn few_bits_are_wrong_and_fewer_with_a_larger_table() {
    let shares = [64, 512].map(|size| {
        let (mut wrong, mut bits) = (0, 0);
        for seed in 0..20 {
            let case = soft_planar(900 + seed, 20, 60, 128);
            let mut inputs = case.inputs(2);
            add_table(&mut inputs, "planar", size);
            let (outputs, _) = run(&PASS, &inputs).unwrap();
            let expected = case.mask();
            let differ = |(a, b): (&u32, &u32)| (a ^ b).count_ones();
            wrong += output(&outputs, "mask").as_u32().iter().zip(&expected).map(differ).sum::<u32>();
            bits += 32 * expected.len();
        }
        f64::from(wrong) / bits as f64
    });
    println!("{shares:?}");
    // Half of these scenes are degenerate: a table does worst there.
    assert!(shares[0] > 0.0 && shares[0] < 0.03 && shares[1] < 0.5 * shares[0], "{shares:?}");
}
