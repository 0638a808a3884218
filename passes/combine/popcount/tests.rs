use super::PASS;
use crate::combine::blocked::tests::visible;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT};

#[test]
fn one_light_sample_is_a_hard_shadow() {
    let states = [KEPT, KEPT, FACING_AWAY, BACKGROUND];
    assert_eq!(visible(&PASS, &[&[0], &[1], &[u32::MAX], &[0]], &states, 1), [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn the_fraction_counts_bits_of_all_words_but_none_past_the_last_light_sample() {
    let masks: [&[u32]; 4] = [&[0, 0], &[0xff, 0], &[u32::MAX, 0xff], &[u32::MAX, u32::MAX]];
    assert_eq!(visible(&PASS, &masks, &[KEPT; 4], 40), [1.0, 0.8, 0.0, 0.0]);
    assert_eq!(visible(&PASS, &[&[0, 0x100]], &[KEPT], 40), [1.0]);
    assert_eq!(visible(&PASS, &[&[u32::MAX, 0]], &[KEPT], 64), [0.5]);
}

#[test]
fn no_light_sample_blocks_nothing() {
    assert_eq!(visible(&PASS, &[&[], &[]], &[KEPT, FACING_AWAY], 0), [1.0, 1.0]);
}
