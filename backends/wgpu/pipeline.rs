//! Pipelines of one device, made once for each distinct (source, entry points, constants, targets).

use crate::pool::format;
use crate::shader::{Class, Entries, Module, join};
use naga::ShaderStage;
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Cull, Dispatch, Draw};
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A pipeline and the layout of its one bind group.
#[derive(Clone, Debug)]
pub(crate) struct Made<P> {
    pub pipeline: P,
    pub bind: wgpu::BindGroupLayout,
}

/// The pipelines of a device.
#[derive(Debug)]
pub(crate) struct Pipelines {
    device: wgpu::Device,
    modules: Mutex<HashMap<String, Arc<(Module, wgpu::ShaderModule)>>>,
    compute: Mutex<HashMap<ComputeKey, Made<wgpu::ComputePipeline>>>,
    render: Mutex<HashMap<RenderKey, Made<wgpu::RenderPipeline>>>,
}

/// Constants by name, as bits.
type Constants = Vec<(&'static str, u64)>;

#[derive(Debug, PartialEq, Eq, Hash)]
struct ComputeKey {
    source: String,
    entry: &'static str,
    constants: Constants,
}

#[derive(Debug, PartialEq, Eq, Hash)]
struct RenderKey {
    source: String,
    entries: (&'static str, Option<&'static str>),
    constants: Constants,
    color: Vec<Storage>,
    depth: Option<bool>,
    cull: u8,
    conservative: bool,
}

impl Pipelines {
    /// None yet.
    pub fn new(device: &wgpu::Device) -> Self {
        Self { device: device.clone(), modules: Mutex::default(), compute: Mutex::default(), render: Mutex::default() }
    }

    /// The pipeline of a dispatch.
    ///
    /// # Errors
    /// Kernel and recipe disagree.
    pub fn compute(
        &self,
        who: &str,
        dispatch: &Dispatch,
        bind: &[Class],
    ) -> Result<Made<wgpu::ComputePipeline>, Problem> {
        let source = join(&dispatch.shader);
        let module = self.module(&source, who)?;
        let visible = module.0.visibility(who, &[(dispatch.entry, ShaderStage::Compute)], bind)?;
        let key = ComputeKey { source, entry: dispatch.entry, constants: bits(&dispatch.shader.constants) };
        Ok(once(&self.compute, key, || {
            let (layout, group) = self.layout(who, bind, &visible);
            let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(who),
                layout: Some(&layout),
                module: &module.1,
                entry_point: Some(dispatch.entry),
                compilation_options: options(&dispatch.shader.constants),
                cache: None,
            });
            Made { pipeline, bind: group }
        }))
    }

    /// The pipeline of a draw whose colour attachments have storages `color`.
    ///
    /// # Errors
    /// Kernel and recipe disagree.
    pub fn render(
        &self,
        who: &str,
        draw: &Draw,
        bind: &[Class],
        color: &[Storage],
    ) -> Result<Made<wgpu::RenderPipeline>, Problem> {
        let source = join(&draw.shader);
        let module = self.module(&source, who)?;
        let mut entries = vec![(draw.vertex, ShaderStage::Vertex)];
        entries.extend(draw.fragment.map(|entry| (entry, ShaderStage::Fragment)));
        let visible = module.0.visibility(who, &entries as &Entries, bind)?;
        let key = RenderKey {
            source,
            entries: (draw.vertex, draw.fragment),
            constants: bits(&draw.shader.constants),
            color: color.to_vec(),
            depth: draw.depth.as_ref().map(|depth| depth.write),
            cull: draw.cull as u8,
            conservative: draw.conservative,
        };
        Ok(once(&self.render, key, || {
            let (layout, group) = self.layout(who, bind, &visible);
            Made { pipeline: self.draw_pipeline(who, draw, color, &module.1, &layout), bind: group }
        }))
    }

    fn draw_pipeline(
        &self,
        who: &str,
        draw: &Draw,
        color: &[Storage],
        module: &wgpu::ShaderModule,
        layout: &wgpu::PipelineLayout,
    ) -> wgpu::RenderPipeline {
        let compilation_options = options(&draw.shader.constants);
        let dummy = color.is_empty() && draw.depth.is_none();
        let target = |format, write_mask| Some(wgpu::ColorTargetState { format, blend: None, write_mask });
        let mut targets: Vec<_> =
            color.iter().map(|storage| target(format(*storage), wgpu::ColorWrites::ALL)).collect();
        if dummy {
            targets.push(target(DUMMY_FORMAT, wgpu::ColorWrites::empty()));
        }
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(who),
            layout: Some(layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(draw.vertex),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleList,
                front_face: wgpu::FrontFace::Ccw,
                cull_mode: match draw.cull {
                    Cull::None => None,
                    Cull::Back => Some(wgpu::Face::Back),
                    Cull::Front => Some(wgpu::Face::Front),
                },
                conservative: draw.conservative,
                ..Default::default()
            },
            depth_stencil: draw.depth.as_ref().map(|depth| wgpu::DepthStencilState {
                format: format(Storage::DepthTexture),
                depth_write_enabled: Some(depth.write),
                depth_compare: Some(match depth.write {
                    true => wgpu::CompareFunction::Less,
                    false => wgpu::CompareFunction::Always,
                }),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: draw.fragment.map(|entry| wgpu::FragmentState {
                module,
                entry_point: Some(entry),
                compilation_options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn module(&self, source: &str, who: &str) -> Result<Arc<(Module, wgpu::ShaderModule)>, Problem> {
        let mut modules = open(&self.modules);
        if let Some(module) = modules.get(source) {
            return Ok(module.clone());
        }
        let checked = Module::new(source, who)?;
        let descriptor =
            wgpu::ShaderModuleDescriptor { label: Some(who), source: wgpu::ShaderSource::Wgsl(source.into()) };
        let module = Arc::new((checked, self.device.create_shader_module(descriptor)));
        modules.insert(source.to_owned(), module.clone());
        Ok(module)
    }

    fn layout(
        &self,
        who: &str,
        bind: &[Class],
        visible: &[wgpu::ShaderStages],
    ) -> (wgpu::PipelineLayout, wgpu::BindGroupLayout) {
        let entries: Vec<_> = bind
            .iter()
            .zip(visible)
            .enumerate()
            .map(|(binding, (class, visibility))| wgpu::BindGroupLayoutEntry {
                binding: binding as u32,
                visibility: *visibility,
                ty: binding_type(*class),
                count: None,
            })
            .collect();
        let group = self
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(who), entries: &entries });
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(who),
            bind_group_layouts: &[Some(&group)],
            immediate_size: 0,
        });
        (layout, group)
    }
}

/// Attachment of a draw that has none of its own: devices demand one.
pub(crate) const DUMMY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

fn binding_type(class: Class) -> wgpu::BindingType {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture =
        |sample_type, view_dimension| wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false };
    match class {
        Class::Uniform(_) => buffer(wgpu::BufferBindingType::Uniform),
        Class::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Class::ReadWrite => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
        Class::Texture(Storage::DepthTexture) => {
            texture(wgpu::TextureSampleType::Depth, wgpu::TextureViewDimension::D2Array)
        }
        Class::Texture(Storage::R32Uint) => texture(wgpu::TextureSampleType::Uint, wgpu::TextureViewDimension::D2),
        Class::Texture(_) => {
            texture(wgpu::TextureSampleType::Float { filterable: false }, wgpu::TextureViewDimension::D2)
        }
    }
}

fn bits(constants: &[(&'static str, f64)]) -> Constants {
    constants.iter().map(|(name, value)| (*name, value.to_bits())).collect()
}

fn options<'a>(constants: &'a [(&'a str, f64)]) -> wgpu::PipelineCompilationOptions<'a> {
    wgpu::PipelineCompilationOptions { constants, ..Default::default() }
}

/// A panic elsewhere leaves these maps whole, so a poisoned lock is taken over.
fn open<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

fn once<K: Eq + Hash, V: Clone>(map: &Mutex<HashMap<K, V>>, key: K, make: impl FnOnce() -> V) -> V {
    if let Some(known) = open(map).get(&key) {
        return known.clone();
    }
    let made = make();
    open(map).insert(key, made.clone());
    made
}
