//! What a device reports, as problems.

use shadowgraph_core::problem::{Kind, Problem};

/// Does `work` and returns what the device reported meanwhile on this thread, if anything, as a problem. Polls nothing.
pub(crate) fn scoped<T>(device: &wgpu::Device, work: impl FnOnce() -> Result<T, Problem>) -> Result<T, Problem> {
    let scopes = [wgpu::ErrorFilter::Internal, wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation]
        .map(|filter| device.push_error_scope(filter));
    let done = work();
    // Every scope is popped, in reverse order, before any report is made: native devices answer at once.
    let errors = scopes.into_iter().rev().map(|scope| pollster::block_on(scope.pop()));
    match errors.collect::<Vec<_>>().into_iter().flatten().next() {
        Some(error) => Err(device_problem(&error)),
        None => done,
    }
}

/// One report.
pub(crate) fn device_problem(error: &wgpu::Error) -> Problem {
    match error {
        wgpu::Error::OutOfMemory { .. } => Problem::new(Kind::Device, "the device is out of memory")
            .remedy("use a smaller picture or resolution, or the CPU backend"),
        other => Problem::new(Kind::Device, "the device refuses a command")
            .found(other.to_string())
            .remedy("use the CPU backend, and report this"),
    }
}

/// The device is gone.
pub(crate) fn lost(reason: &str) -> Problem {
    Problem::new(Kind::Device, "the device was lost").found(reason).remedy("run again, or use the CPU backend")
}
