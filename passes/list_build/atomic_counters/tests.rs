use super::PASS;
use crate::ports;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::record::{Command, DeviceLimits, GpuCx, Target};
use shadowgraph_core::size::SizeCx;

#[test]
fn counters_start_from_zero_on_a_device() {
    let params = Params(vec![("size", Value::U32(3))]);
    let mut shapes = vec![
        (ports::POSITION.name, vec![10, 3]),
        (ports::SAMPLE_STATE.name, vec![10]),
        (ports::LIGHT_FRAME.name, vec![6, 20]),
    ];
    let outputs = (PASS.size)(&SizeCx { image: [5, 2], params: &params, inputs: &shapes, grown: &[] });
    assert_eq!(outputs[2], (ports::LIST_LENGTH.name, vec![6, 3, 3]));
    shapes.extend(outputs);
    let limits = DeviceLimits { storage_binding_bytes: 1 << 27, texture_side: 8192, storage_buffers: 8 };
    let mut cx = GpuCx::new(&PASS, &params, [5, 2], shapes, limits);
    super::gpu::record(&mut cx).unwrap();
    let (_, commands) = cx.finish();
    let zeroed = |port| commands.contains(&Command::Zero(Target::Port(port)));
    assert!(zeroed(ports::LIST_LENGTH.name) && zeroed(ports::LIST_FAR.name));
}
