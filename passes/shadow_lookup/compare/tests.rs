use super::PASS;
use crate::ports;
use crate::shared::light_frame::Face;
use glam::Vec3;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT};

fn run(light_samples: usize) -> Result<(Vec<u32>, Vec<f32>), Problem> {
    let face = Face {
        origin: Vec3::ZERO,
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Z,
        axis_z: -Vec3::Y,
        window_low: [-1.0; 2],
        window_size: [2.0; 2],
        near: 1.0,
        far: 4.0,
    };
    // Texel (0, 0) of 2 x 2 holds something at the near plane.
    let inputs = [
        (ports::DEPTH.name, Array::f32([1, 2, 2], vec![0.0, 1.0, 1.0, 1.0])),
        (ports::LIGHT_FRAME.name, Array::f32([1, 20], face.to_words().to_vec())),
        (ports::POSITION.name, Array::f32([4, 3], vec![-1., -2., -1., 1., -2., 1., -1., -2., -1., -1., -2., -1.])),
        (ports::NORMAL.name, Array::f32([4, 3], [0.0, 1.0, 0.0].repeat(4))),
        (ports::SAMPLE_STATE.name, Array::u32([4], vec![KEPT, KEPT, FACING_AWAY, BACKGROUND])),
        (input::LIGHT_SAMPLES.name, Array::f32([light_samples, 3], vec![0.0; 3 * light_samples])),
    ];
    let params = Params::defaults(PASS.params);
    let inputs = inputs.iter().map(|(port, array)| (*port, array)).collect();
    let mut cx = CpuCx::new(&PASS, &params, [2, 2], inputs, &|_, _| {});
    super::run(&mut cx)?;
    let (outputs, _) = cx.finish();
    let port = |name: &str| &outputs.iter().find(|(port, _)| *port == name).unwrap().1;
    Ok((port(ports::MASK.name).as_u32().to_vec(), port(ports::VISIBLE.name).as_f32().to_vec()))
}

#[test]
fn every_state_has_its_mask_and_share() {
    assert_eq!(run(1).unwrap(), (vec![1, 0, u32::MAX, 0], vec![0.0, 1.0, 0.0, 1.0]));
}

#[test]
fn more_than_one_light_sample_is_refused() {
    assert_eq!(run(2).unwrap_err().kind, Kind::Unsupported);
}
