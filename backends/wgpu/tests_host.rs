//! The way of a host that owns device, queue and encoder.

use crate::limits::required_limits;
use crate::readback::read_words;
use crate::tests::{ADD_ONE, chain};
use crate::{Externals, Prepared, Request, Session};
use shadowgraph_core::array::Array;
use shadowgraph_core::problem::Kind;

fn buffer(device: &wgpu::Device, words: u64) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    device.create_buffer(&wgpu::BufferDescriptor { label: None, size: words * 4, usage, mapped_at_creation: false })
}

#[test]
fn a_host_binds_its_own_buffers_and_splices_its_own_work() {
    let Some(session) = Session::shared_or_skip("a_host_binds_its_own_buffers_and_splices_its_own_work") else {
        return;
    };
    let (device, queue) = (session.device(), session.queue());
    let plan = chain(&ADD_ONE, 4);
    let shapes = [("value".to_owned(), vec![3])];
    let request = Request { external: &["value", "result", "n1.sum"], ..Request::new(&plan, &shapes, [1, 1]) };
    let prepared = Prepared::prepare(device, queue, &request).unwrap();
    assert_eq!(prepared.shape("result"), Ok(&[3][..]));
    assert!(prepared.buffer("value").is_none(), "the host's, not ours");

    // The input starts at byte 256 of a larger buffer.
    let (value, middle, result) = (buffer(device, 100), buffer(device, 3), buffer(device, 3));
    queue.write_buffer(&value, 256, bytemuck::cast_slice(&[1u32, 2, 3]));
    let externals =
        Externals::new().buffer_at("value", &value, 256).buffer("n1.sum", &middle).buffer("result", &result);
    let mut encoder = device.create_command_encoder(&Default::default());
    prepared.record_range(&mut encoder, &externals, 0..2).unwrap();
    // The host's own work between two stages: the middle of the graph becomes zero.
    encoder.clear_buffer(&middle, 0, Some(8));
    prepared.record_range(&mut encoder, &externals, 2..4).unwrap();
    queue.submit([encoder.finish()]);
    assert_eq!(read_words(device, queue, &result, 0, 3).unwrap(), [2, 2, 7]);
}

#[test]
fn what_a_host_binds_wrongly_is_a_problem_that_names_it() {
    let Some(session) = Session::shared_or_skip("what_a_host_binds_wrongly_is_a_problem_that_names_it") else { return };
    let (device, queue) = (session.device(), session.queue());
    let plan = chain(&ADD_ONE, 1);
    let shapes = [("value".to_owned(), vec![3])];
    let request = Request { external: &["value"], ..Request::new(&plan, &shapes, [1, 1]) };
    let prepared = Prepared::prepare(device, queue, &request).unwrap();
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut refuse = |externals: &Externals| prepared.record(&mut encoder, externals).unwrap_err();
    let good = buffer(device, 3);
    assert_eq!(refuse(&Externals::new()).kind, Kind::Missing);
    let problem = refuse(&Externals::new().buffer("value", &buffer(device, 2)));
    assert_eq!(problem.to_string(), "value: the host's resource does not fit; expected 12 bytes; found 8 bytes");
    let problem = refuse(&Externals::new().buffer("value", &good).buffer("valeu", &good));
    assert_eq!((problem.kind, problem.expected.as_deref()), (Kind::UnknownName, Some("one of value, result")));
    let problem = refuse(&Externals::new().buffer("value", &good).buffer("result", &good));
    assert_eq!(
        (problem.port.as_deref(), problem.remedy.as_deref()),
        (Some("result"), Some("name it in Request::external"))
    );
    let problem = prepared.upload(queue, "value", &Array::u32([3], vec![0; 3])).unwrap_err();
    assert_eq!(problem.message, "this input is bound by the host");
    assert_eq!(Prepared::prepare(device, queue, &Request::new(&plan, &[], [1, 1])).unwrap_err().kind, Kind::Missing);
}

#[test]
fn a_host_uploads_records_and_judges_the_status_itself() {
    let Some(session) = Session::shared_or_skip("a_host_uploads_records_and_judges_the_status_itself") else { return };
    let (device, queue) = (session.device(), session.queue());
    let plan = chain(&ADD_ONE, 2);
    let shapes = [("value".to_owned(), vec![2])];
    let prepared = Prepared::prepare(device, queue, &Request::new(&plan, &shapes, [1, 1])).unwrap();
    prepared.upload(queue, "value", &Array::u32([2], vec![40, 50])).unwrap();
    let mut encoder = device.create_command_encoder(&Default::default());
    prepared.record(&mut encoder, &Externals::new()).unwrap();
    queue.submit([encoder.finish()]);
    let result = prepared.buffer("result").expect("kept slots have a buffer");
    assert_eq!(read_words(device, queue, result, 0, 2).unwrap(), [42, 52]);
    assert_eq!((prepared.status_words(), prepared.judge(&[])), (0, Default::default()));
}

#[test]
fn limits_are_known_without_a_device() {
    let plan = chain(&ADD_ONE, 2);
    let shapes = [("value".to_owned(), vec![100_000_000])];
    let request = Request::new(&plan, &shapes, [1, 1]);
    let mut adapter = wgpu::Limits::default();
    assert_eq!(required_limits(&request, &adapter).unwrap_err().kind, Kind::Overflow);
    (adapter.max_storage_buffer_binding_size, adapter.max_buffer_size) = (1 << 30, 1 << 30);
    let limits = required_limits(&request, &adapter).unwrap();
    assert_eq!((limits.max_storage_buffer_binding_size, limits.max_buffer_size), (400_000_000, 400_000_000));
    adapter.max_storage_buffers_per_shader_stage = 1;
    let problem = required_limits(&request, &adapter).unwrap_err();
    assert_eq!(
        (problem.node.as_deref(), problem.expected.as_deref()),
        (Some("n0"), Some("a device with 2 in a stage"))
    );
}
