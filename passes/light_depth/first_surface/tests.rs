use super::{PASS, cpu::nearest, gpu};
use crate::light_depth::SIZE;
use crate::ports;
use crate::shared::light_frame::Face;
use crate::shared::shadow_map::linear_from_depth;
use glam::Vec3;
use shadowgraph_core::input;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::problem::Kind;
use shadowgraph_core::record::{Command, DeviceLimits, GpuCx};

/// Two faces back to back, the light at the origin between them; the second has no view-samples.
fn frame() -> Vec<f32> {
    let down = Face {
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
    let up = Face { axis_z: Vec3::Y, valid: false, ..down };
    [down.to_words(), up.to_words()].concat()
}

#[test]
fn the_nearer_of_two_sheets_is_kept_on_the_face_that_sees_them() {
    let sheet = |y: f32| [[-9.0, y, -9.0], [9.0, y, -9.0], [0.0, y, 30.0]];
    let depth = nearest(&frame(), 16, &[sheet(-3.0), sheet(-2.0), sheet(1.0)], &[1; 3]);
    assert!(depth[..256].iter().all(|depth| (linear_from_depth(*depth, 4.0) - 2.0).abs() < 1e-3));
    assert!(depth[256..].iter().all(|depth| *depth == 1.0));
    let without = nearest(&frame(), 16, &[sheet(-3.0), sheet(-2.0)], &[1, 0]);
    assert!(without[..256].iter().all(|depth| (linear_from_depth(*depth, 4.0) - 3.0).abs() < 1e-3));
}

fn record(side: u32, texture_side: u32) -> Result<Vec<Command>, Kind> {
    let params = Params(vec![(SIZE.name, Value::U32(side))]);
    let side = side as usize;
    let shapes = vec![
        (input::TRIANGLES.name, vec![5, 3, 3]),
        (ports::CASTER_STATE.name, vec![5]),
        (ports::LIGHT_FRAME.name, vec![6, 20]),
        (ports::DEPTH.name, vec![6, side, side]),
    ];
    let limits = DeviceLimits { storage_binding_bytes: 1 << 27, texture_side, storage_buffers: 8 };
    let mut cx = GpuCx::new(&PASS, &params, [1, 1], shapes, limits);
    gpu::record(&mut cx).map_err(|problem| problem.kind)?;
    Ok(cx.finish().1)
}

#[test]
fn every_face_is_drawn_and_a_map_too_large_for_the_device_is_refused() {
    assert_eq!(record(8192, 8192).unwrap().len(), 6);
    assert_eq!(record(8192, 4096).unwrap_err(), Kind::Unsupported);
}
