use super::cpu::gather;
use super::texture_size;
use shadowgraph_core::problem::Kind;
use shadowgraph_core::shared::NO_TRIANGLE;

#[test]
fn texels_lose_their_fourth_word_and_background_is_zero() {
    let positions = [[1.0, 2.0, 3.0, 9.0], [f32::NAN; 4]];
    let normals = [[0.0, 1.0, 0.0, 9.0], [f32::NAN; 4]];
    let seen = gather(&positions, &normals, &[4, NO_TRIANGLE]);
    assert_eq!(seen.positions, [[1.0, 2.0, 3.0], [0.0; 3]]);
    assert_eq!(seen.normals, [[0.0, 1.0, 0.0], [0.0; 3]]);
    assert_eq!(seen.triangles, [4, NO_TRIANGLE]);
}

#[test]
fn missing_and_mismatched_textures_are_named() {
    let none = texture_size(|name| (name != "gbuffer_normal").then_some([2, 3, 4].as_slice())).unwrap_err();
    assert_eq!((none.kind, none.port.as_deref()), (Kind::Missing, Some("gbuffer_normal")));
    let other = texture_size(|name| Some(if name == "gbuffer_triangle" { [3, 3].as_slice() } else { &[2, 3, 4] }));
    let other = other.unwrap_err();
    assert_eq!((other.kind, other.port.as_deref()), (Kind::PortMismatch, Some("gbuffer_triangle")));
    assert_eq!(texture_size(|_| Some([2, 3, 4].as_slice())), Ok([2, 3]));
}
