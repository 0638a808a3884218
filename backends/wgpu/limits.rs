//! Limits of a plan in wgpu's terms, known before a device exists.

use crate::prepare::{Laid, Request, lay_out};
use shadowgraph_core::plan::Node;
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, Command, DeviceLimits};

/// A device's limits in the words of recipes.
pub fn device_limits(limits: &wgpu::Limits) -> DeviceLimits {
    DeviceLimits {
        storage_binding_bytes: limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
        texture_side: limits.max_texture_dimension_2d,
        storage_buffers: limits.max_storage_buffers_per_shader_stage,
    }
}

/// Storage buffers among the bindings of a command.
pub(crate) fn storage_buffers(bind: &[Bind]) -> u32 {
    bind.iter().filter(|bind| matches!(bind, Bind::Read(_) | Bind::ReadWrite(_))).count() as u32
}

/// Whether a stage may bind so many storage buffers.
pub(crate) fn check_buffers(node: &Node, buffers: u32, limits: &wgpu::Limits) -> Result<(), Problem> {
    let most = limits.max_storage_buffers_per_shader_stage;
    if buffers <= most {
        return Ok(());
    }
    Err(Problem::new(Kind::Unsupported, format!("pass {:?} binds many storage buffers", node.pass))
        .node(&node.id)
        .expected(format!("a device with {buffers} in a stage"))
        .found(most.to_string())
        .remedy("choose another pass of the stage, another adapter, or `on: Cpu`"))
}

/// Limits to ask for when the host makes its device, at least WebGPU's defaults; `adapter` is what its adapter can do.
///
/// # Errors
/// What the adapter cannot do, with the node; an input that is missing; what a recipe reports.
pub fn required_limits(request: &Request, adapter: &wgpu::Limits) -> Result<wgpu::Limits, Problem> {
    let Laid { recipes, layout, .. } = lay_out(request, device_limits(adapter))?;
    layout.check(adapter, request.budget_bytes)?;
    let mut limits = wgpu::Limits::default();
    for want in &layout.wants {
        if want.storage == Storage::Buffer {
            limits.max_storage_buffer_binding_size = limits.max_storage_buffer_binding_size.max(want.bytes);
            limits.max_buffer_size = limits.max_buffer_size.max(want.bytes);
        } else {
            let side = want.extent[0].max(want.extent[1]);
            limits.max_texture_dimension_2d = limits.max_texture_dimension_2d.max(side);
            limits.max_texture_array_layers = limits.max_texture_array_layers.max(want.extent[2]);
        }
    }
    for (index, recipe) in recipes.iter().enumerate() {
        for command in recipe.iter().flat_map(|recipe| &recipe.commands) {
            let (bind, attachment_bytes) = match command {
                Command::Dispatch(dispatch) => (&dispatch.bind, 0),
                // 16 bytes a texel is the most one attachment takes.
                Command::Draw(draw) => (&draw.bind, 16 * draw.color.len() as u32),
                Command::Zero(_) | Command::Copy { .. } => continue,
            };
            let buffers = storage_buffers(bind);
            check_buffers(&request.plan.nodes[index], buffers, adapter)?;
            limits.max_storage_buffers_per_shader_stage = limits.max_storage_buffers_per_shader_stage.max(buffers);
            let of_stage = &mut limits.max_buffers_and_acceleration_structures_per_shader_stage;
            *of_stage = (*of_stage).max(bind.len() as u32);
            let attachments = &mut limits.max_color_attachment_bytes_per_sample;
            *attachments = (*attachments).max(attachment_bytes);
        }
    }
    Ok(limits)
}

/// Everything of `adapter` that graphs can use, for a device of our own.
pub(crate) fn useful_limits(adapter: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_texture_dimension_2d: adapter.max_texture_dimension_2d,
        max_texture_array_layers: adapter.max_texture_array_layers,
        max_storage_buffers_per_shader_stage: adapter.max_storage_buffers_per_shader_stage,
        max_buffers_and_acceleration_structures_per_shader_stage: adapter
            .max_buffers_and_acceleration_structures_per_shader_stage,
        max_storage_buffer_binding_size: adapter.max_storage_buffer_binding_size,
        max_uniform_buffer_binding_size: adapter.max_uniform_buffer_binding_size,
        max_buffer_size: adapter.max_buffer_size,
        max_color_attachment_bytes_per_sample: adapter.max_color_attachment_bytes_per_sample,
        max_compute_workgroup_storage_size: adapter.max_compute_workgroup_storage_size,
        max_compute_invocations_per_workgroup: adapter.max_compute_invocations_per_workgroup,
        max_compute_workgroup_size_x: adapter.max_compute_workgroup_size_x,
        max_compute_workgroup_size_y: adapter.max_compute_workgroup_size_y,
        max_compute_workgroup_size_z: adapter.max_compute_workgroup_size_z,
        ..wgpu::Limits::default()
    }
}
