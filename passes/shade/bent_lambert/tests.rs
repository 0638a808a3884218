use super::PASS;
use super::cpu::light_term;
use crate::ports;
use crate::shade::surface::Surface;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_TRIANGLE};

fn surface(toward_light: Vec3, is_flipped: bool) -> Surface {
    let geometric_normal = if is_flipped { -Vec3::Y } else { Vec3::Y };
    Surface {
        position: Vec3::ZERO,
        triangle: 0,
        weights: Vec3::splat(1.0 / 3.0),
        is_flipped,
        geometric_normal,
        shading_normal: geometric_normal,
        toward_light,
        albedo: Vec3::ONE,
        light: Vec3::ONE,
        visible: Vec3::ONE,
    }
}

#[test]
fn the_term_blends_from_bent_to_smooth_as_the_paper_says() {
    let lit = surface(Vec3::Y, false);
    // alpha = 1 from l_bend = 1/3 on, 0.3 at 0.1: 0.3 * 1 + 0.7 * 0.1.
    for (bend, expected) in [(1.0, 1.0), (1.0 / 3.0, 1.0), (0.1, 0.37), (0.0, 0.0), (-0.5, 0.0)] {
        assert!((light_term(&lit, Vec3::splat(bend), 3.0) - expected).abs() < 1e-6, "{bend}");
    }
    // Without the blend only l_bend is left.
    assert!((light_term(&lit, Vec3::splat(0.4), 0.0) - 0.4).abs() < 1e-6);
}

#[test]
fn a_surface_seen_from_behind_is_lit_from_behind_only() {
    // Lit from above: black from below, whatever the corners say. Lit from below: as bright as the other side would be.
    assert_eq!(light_term(&surface(Vec3::Y, true), Vec3::ONE, 3.0), 0.0);
    assert_eq!(light_term(&surface(Vec3::Y, true), -Vec3::ONE, 3.0), 0.0);
    assert_eq!(light_term(&surface(-Vec3::Y, true), -Vec3::ONE, 3.0), 1.0);
}

#[test]
fn states_pixels_and_background_make_the_picture() {
    let triangle = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0];
    let inputs = [
        (ports::POSITION.name, Array::f32([5, 3], [0.25, 0.0, 0.25].repeat(5))),
        (ports::NORMAL.name, Array::f32([5, 3], [0.0, 1.0, 0.0].repeat(5))),
        (ports::TRIANGLE.name, Array::u32([5], vec![0, 0, NO_TRIANGLE, 0, 0])),
        (ports::PIXEL.name, Array::u32([5], vec![3, 0, 1, 4, 2])),
        (ports::SAMPLE_STATE.name, Array::u32([5], vec![KEPT, FACING_AWAY, BACKGROUND, KEPT, KEPT])),
        (ports::VISIBLE.name, Array::f32([5], vec![1.0, 0.0, 1.0, 1.0, 0.5])),
        (input::TRIANGLES.name, Array::f32([1, 3, 3], triangle.to_vec())),
        (input::TRIANGLE_NORMALS.name, Array::f32([1, 3, 3], [0.0, 1.0, 0.0].repeat(3))),
        (input::TRIANGLE_ALBEDO.name, Array::f32([1, 3], vec![0.5, 0.25, 1.0])),
        (ports::CORNER_LIGHT.name, Array::f32([1, 3], vec![1.0; 3])),
        (input::LIGHT.name, Array::f32([8], vec![0.25, 4.0, 0.25, 0.0, 1.0, 1.0, 2.0, 0.0])),
    ];
    let mut params = Params::defaults(PASS.params);
    let mut set = |name: &str, value: Value| params.0.iter_mut().find(|(key, _)| *key == name).unwrap().1 = value;
    set("ambient", Value::F32(0.5));
    set("background_red", Value::F32(0.75));
    set("falloff", Value::Word("inverse_square".into()));
    set("falloff_distance", Value::F32(2.0));
    let inputs = inputs.iter().map(|(port, array)| (*port, array)).collect();
    let mut cx = CpuCx::new(&PASS, &params, [2, 2], inputs, &|_, _| {});
    super::cpu::run(&mut cx).unwrap();
    let (outputs, counts) = cx.finish();
    assert_eq!(counts, [1], "pixel 4 is outside");
    let image = outputs[0].1.as_f32();
    // At twice the falloff distance a quarter of the light is left.
    let expected = [
        [0.25, 0.125, 0.5, 1.0],
        [0.75, 0.06, 0.08, 0.0],
        [0.25 + 0.0625, 0.125 + 0.03125, 0.5 + 0.25, 1.0],
        [0.25 + 0.125, 0.125 + 0.0625, 0.5 + 0.5, 1.0],
    ];
    for (found, expected) in image.iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-5, "{image:?}");
    }
}
