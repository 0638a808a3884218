use super::cpu::light_facing;
use shadowgraph_core::shared::NO_TRIANGLE;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const DOWN: [f32; 3] = [0.0, -1.0, 0.0];

#[test]
fn a_lamp_above_keeps_what_looks_up() {
    let light = [[0.0, 5.0, 0.0]];
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 5.0, 3.0], [0.0; 3], [f32::INFINITY, 0.0, 0.0]];
    // The third lies in the plane through the light: not above it, so dropped.
    let states = light_facing(&positions, &[UP, DOWN, UP, UP, UP], &[0, 0, 0, NO_TRIANGLE, 0], &light);
    assert_eq!(states, [1, 2, 2, 0, 0]);
}

#[test]
fn one_light_sample_in_front_is_enough() {
    let positions = [[0.0; 3]];
    assert_eq!(light_facing(&positions, &[UP], &[0], &[[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]]), [1]);
    assert_eq!(light_facing(&positions, &[UP], &[0], &[[0.0, -1.0, 0.0], [0.0, -2.0, 0.0]]), [2]);
}

#[test]
fn the_sign_is_that_of_the_stored_words_where_single_precision_rounds_to_zero() {
    // 0.6 * 4 - 0.8 * 3 is zero in f32; on the stored words, both above their decimals, it is 6e-8.
    assert_eq!(light_facing(&[[0.0; 3]], &[[0.6, 0.8, 0.0]], &[0], &[[4.0, -3.0, 0.0]]), [1]);
    assert_eq!(light_facing(&[[0.0; 3]], &[[-0.6, -0.8, 0.0]], &[0], &[[4.0, -3.0, 0.0]]), [2]);
}
