use super::PASS;
use crate::shared::hard_scenes::{output, run};
use shadowgraph_core::array::Array;

#[test]
fn a_tetrahedron_is_closed_until_a_side_of_it_does_not_cast() {
    let [o, x, y, z] = [[0.0f32; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let sides = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
    let across = |states: [u32; 4]| {
        let triangles = Array::f32([4, 3, 3], sides.into_iter().flatten().flatten().collect());
        let inputs = vec![("triangles", triangles), ("caster_state", Array::u32([4], states.to_vec()))];
        let (outputs, counts) = run(&PASS, &inputs).unwrap();
        (output(&outputs, "across").as_u32().to_vec(), counts[0])
    };
    const N: u32 = u32::MAX;
    assert_eq!(across([1; 4]), (vec![2, 3, 1, 0, 3, 2, 1, 3, 0, 0, 2, 1], 0));
    assert_eq!(across([1, 1, 1, 0]), (vec![2, N, 1, 0, N, 2, 1, N, 0, N, N, N], 3));
    assert_eq!(across([0; 4]), (vec![N; 12], 0));
}
