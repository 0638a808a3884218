use super::PASS;
use crate::combine::blocked::tests::visible;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT};

#[test]
fn half_of_the_light_samples_make_a_shadow() {
    let masks: [&[u32]; 4] = [&[0], &[0b001], &[0b011], &[0b1111]];
    assert_eq!(visible(&PASS, &masks, &[KEPT; 4], 4), [1.0, 1.0, 0.0, 0.0]);
    assert_eq!(visible(&PASS, &[&[0b01], &[0b11]], &[KEPT; 2], 3), [1.0, 0.0]);
}

#[test]
fn background_is_lit_and_what_faces_away_is_not() {
    assert_eq!(visible(&PASS, &[&[u32::MAX], &[u32::MAX]], &[BACKGROUND, FACING_AWAY], 5), [1.0, 0.0]);
    assert_eq!(visible(&PASS, &[&[]], &[KEPT], 0), [1.0]);
}
