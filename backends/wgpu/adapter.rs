//! Choosing an adapter, and what records say about it.

use crate::limits::useful_limits;
use shadowgraph_core::problem::{Kind, Problem};

/// Which adapter a program wants.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Part of its name, case ignored; none: any.
    pub name: Option<String>,
}

/// What records say about an adapter.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct AdapterFacts {
    /// Its name.
    pub name: String,
    /// Driver.
    pub driver: String,
    /// Driver version and build.
    pub driver_info: String,
    /// `vulkan`, `metal`, ...
    pub backend: String,
    /// `discrete_gpu`, `integrated_gpu`, `virtual_gpu`, `cpu` (a software rasteriser) or `other`.
    pub device_type: &'static str,
}

impl AdapterFacts {
    fn new(info: &wgpu::AdapterInfo) -> Self {
        Self {
            name: info.name.clone(),
            driver: info.driver.clone(),
            driver_info: info.driver_info.clone(),
            backend: info.backend.to_string(),
            device_type: match info.device_type {
                wgpu::DeviceType::DiscreteGpu => "discrete_gpu",
                wgpu::DeviceType::IntegratedGpu => "integrated_gpu",
                wgpu::DeviceType::VirtualGpu => "virtual_gpu",
                wgpu::DeviceType::Cpu => "cpu",
                wgpu::DeviceType::Other => "other",
            },
        }
    }
}

/// An adapter with a device of our own.
pub(crate) struct Opened {
    pub facts: AdapterFacts,
    pub kind: wgpu::DeviceType,
    pub capabilities: wgpu::DownlevelFlags,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

/// Opens the best adapter that `wanted` allows: hardware before software.
pub(crate) fn open(wanted: &Wanted) -> Result<Opened, Problem> {
    // wgpu validates by itself; the driver's validation layers only cost here. `WGPU_DEBUG=1` brings labels into captures.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        flags: wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL.with_env(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let names: Vec<String> = all.iter().map(|adapter| adapter.get_info().name).collect();
    let fits = |adapter: &wgpu::Adapter| {
        let name = adapter.get_info().name.to_lowercase();
        let can = adapter.get_downlevel_capabilities().flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS);
        can && wanted.name.as_ref().is_none_or(|part| name.contains(&part.to_lowercase()))
    };
    let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    let Some(adapter) = all.into_iter().filter(fits).min_by_key(rank) else {
        let found = if names.is_empty() { "none".into() } else { names.join(", ") };
        let expected = match &wanted.name {
            Some(name) => format!("an adapter whose name contains {name:?}"),
            None => "an adapter with compute shaders".into(),
        };
        return Err(Problem::new(Kind::Device, "there is no such GPU adapter")
            .expected(expected)
            .found(found)
            .remedy("use the CPU backend, or install a Vulkan driver such as Mesa's lavapipe"));
    };
    let useful = wgpu::Features::TIMESTAMP_QUERY
        | wgpu::Features::PIPELINE_STATISTICS_QUERY
        | wgpu::Features::CONSERVATIVE_RASTERIZATION;
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("shadowgraph"),
        required_features: adapter.features() & useful,
        required_limits: useful_limits(&adapter.limits()),
        ..Default::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
        Problem::new(Kind::Device, "the adapter gives no device")
            .found(error.to_string())
            .remedy("use the CPU backend, or another adapter")
    })?;
    let info = adapter.get_info();
    Ok(Opened {
        facts: AdapterFacts::new(&info),
        kind: info.device_type,
        capabilities: adapter.get_downlevel_capabilities().flags,
        device,
        queue,
    })
}
