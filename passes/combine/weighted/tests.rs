use super::PASS;
use super::cpu::Weights;
use crate::combine::blocked::tests::visible;
use crate::combine::popcount;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::Kind;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT};

/// `visible` and `visible_color` of masks of one word.
fn weighted(masks: &[u32], states: &[u32], weights: &[[f32; 3]]) -> (Vec<f32>, Vec<[f32; 3]>) {
    let mask = Array::u32([masks.len(), weights.len().div_ceil(32)], masks.to_vec());
    let states = Array::u32([states.len()], states.to_vec());
    let weights = Array::f32([weights.len(), 3], weights.as_flattened().to_vec());
    let params = Params::default();
    let inputs = vec![("mask", &mask), ("sample_state", &states), ("light_weights", &weights)];
    let mut cx = CpuCx::new(&PASS, &params, [1, 1], inputs, &|_, _| {});
    super::cpu::run(&mut cx).expect("combines");
    let outputs = cx.finish().0;
    (outputs[0].1.as_f32().to_vec(), outputs[1].1.as_vec3().to_vec())
}

#[test]
fn red_and_green_halves_are_counted_by_hand() {
    // Three red, one green, one blue light sample; weights sum to 1 in every channel.
    let third = 1.0 / 3.0;
    let weights = [[third, 0.0, 0.0], [third, 0.0, 0.0], [third, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let masks = [0, 0b00111, 0b01000, 0b10001, u32::MAX, u32::MAX, 0b11111];
    let states = [KEPT, KEPT, KEPT, KEPT, FACING_AWAY, BACKGROUND, KEPT];
    let (visible, color) = weighted(&masks, &states, &weights);
    let expected = [1.0, 0.7874, 0.2848, 0.2126 * 2.0 / 3.0 + 0.7152, 0.0, 1.0, 0.0];
    for (found, expected) in visible.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{visible:?}");
    }
    assert_eq!((visible[0], visible[4], visible[5], visible[6]), (1.0, 0.0, 1.0, 0.0), "both ends are exact");
    let expected = [[1.0; 3], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [2.0 * third, 1.0, 0.0], [0.0; 3], [1.0; 3], [0.0; 3]];
    for (found, expected) in color.iter().zip(expected) {
        assert!((Vec3::from(*found) - Vec3::from(expected)).length() < 1e-6, "{color:?}");
    }
}

#[test]
fn uniform_weights_agree_with_popcount() {
    let mut state = 1u32;
    let mut word = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        // Words that are empty, full and mixed.
        match state >> 30 {
            0 => 0,
            1 => u32::MAX,
            _ => state,
        }
    };
    for samples in [1usize, 31, 32, 33, 257, 4096] {
        let rows = vec![[1.0 / samples as f32; 3]; samples];
        let weights = Weights::new(&rows);
        for _ in 0..20 {
            let mask: Vec<u32> = (0..samples.div_ceil(32)).map(|_| word()).collect();
            let counted = visible(&popcount::PASS, &[&mask], &[KEPT], samples)[0];
            let found = weights.share(weights.lit(&mask));
            assert!((found - counted).abs() <= 1e-5, "{samples}: {found} not {counted}");
        }
    }
}

#[test]
fn a_light_without_luminance_and_no_light_sample_block_nothing() {
    assert_eq!(weighted(&[0b1], &[KEPT], &[[0.0; 3]; 2]).0, [1.0]);
    assert_eq!(weighted(&[], &[KEPT], &[]), (vec![1.0], vec![[0.0; 3]]));
}

#[test]
fn weights_of_other_samples_are_refused() {
    let problem = super::check_weights(33, 1).expect_err("two words are needed");
    assert_eq!((problem.kind, problem.port.as_deref()), (Kind::BadValue, Some("light_weights")));
}
