//! What makes Mesa's llvmpipe wait for the fragments of a draw.
//!
//! llvmpipe rasterises in the background, but runs a dispatch at once. It heeds a barrier only in the middle of a command buffer
//! (seen with Mesa 22.3.6), and wgpu records what must come before a pass as a command buffer of its own. So a dispatch after
//! a draw may not see what the fragments store (a mask that was gathered right after its fragments in one submission came
//! out empty, every time), and may overwrite what they have yet to read. Between two dispatches of one
//! pass that write the same buffer the barrier is where llvmpipe heeds it: two of one invocation each follow every draw.

/// The two dispatches.
#[derive(Debug)]
pub(crate) struct Settle {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

const SOURCE: &str = "
@group(0) @binding(0) var<storage, read_write> draws: array<u32>;
@compute @workgroup_size(1) fn settle() { draws[0] += 1u; }";

impl Settle {
    /// On a device that needs it.
    pub fn new(device: &wgpu::Device) -> Option<Self> {
        if device.adapter_info().driver != "llvmpipe" {
            return None;
        }
        let source = wgpu::ShaderSource::Wgsl(SOURCE.into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("settle"), source });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("settle"),
            layout: None,
            module: &module,
            entry_point: Some("settle"),
            compilation_options: Default::default(),
            cache: None,
        });
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("settle"),
            size: 4,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("settle"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Some(Self { pipeline, group })
    }

    /// Records them.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        pass.dispatch_workgroups(1, 1, 1);
    }
}
