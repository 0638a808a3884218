use super::PASS;
use crate::shared::area_light_scenes::{SoftCase, add_table, disc, soft_planar, soft_tilted};
use crate::shared::hard_scenes::{Random, output, run};

/// Wrong bits of all, over twenty scenes.
fn wrong_share(scene: impl Fn(u64) -> SoftCase, size: u32) -> f64 {
    let (mut wrong, mut bits) = (0, 0);
    for seed in 0..20 {
        let case = scene(seed);
        let mut inputs = case.inputs(2);
        add_table(&mut inputs, "planar", size);
        let (outputs, _) = run(&PASS, &inputs).unwrap();
        let expected = case.mask();
        let differ = |(a, b): (&u32, &u32)| (a ^ b).count_ones();
        wrong += output(&outputs, "mask").as_u32().iter().zip(&expected).map(differ).sum::<u32>();
        bits += 32 * expected.len();
    }
    f64::from(wrong) / bits as f64
}

#[test]
fn few_bits_are_wrong_and_fewer_with_a_larger_table() {
    let shares = [64, 512].map(|size| wrong_share(|seed| soft_planar(900 + seed, 20, 60, 128), size));
    println!("{shares:?}");
    // Half of these scenes are degenerate: a table does worst there.
    assert!(shares[0] > 0.0 && shares[0] < 0.03 && shares[1] < 0.5 * shares[0], "{shares:?}");
}

#[test]
fn a_light_tilted_about_two_axes_is_no_worse() {
    let shares = [64, 512].map(|size| wrong_share(|seed| soft_tilted(900 + seed, 20, 60, 128), size));
    println!("{shares:?}");
    assert!(shares[0] > 0.0 && shares[0] < 0.03 && shares[1] < 0.5 * shares[0], "{shares:?}");
}

#[test]
fn three_samples_far_off_the_middle_of_their_box_are_looked_up_in_their_plane() {
    // The box of a few samples of a tilted disc has its middle furthest from their plane: what a table does not take for its own.
    let scene = |seed| {
        let mut case = soft_tilted(40 + seed, 20, 60, 3);
        let far = (0..3).map(|k| (case.case.light[k] - case.case.position[0][k]).abs()).fold(0.0, f32::max);
        case.samples = disc(&mut Random(seed), case.case.light, [1.0, 1.0, 1.0], 0.5 * far, 3);
        case
    };
    let share = wrong_share(scene, 1024);
    println!("{share}");
    // Three bits of each word are in use.
    assert!(share < 0.003 * 3.0 / 32.0, "{share}");
}
