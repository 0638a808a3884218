//! From arrays to device memory.

use crate::errors::scoped;
use crate::externals::slot_named;
use crate::pool::{Home, Memory};
use crate::prepare::Prepared;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Producer, SlotId};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};

/// Words written at once: a write is staged whole, and large values must not be staged twice over.
const PIECE_WORDS: usize = 16 << 20;

impl Prepared {
    /// Writes the value of graph input `name`; it is there from the next submission on. An input that no wgpu node reads is
    /// passed over.
    ///
    /// # Errors
    /// No such input, another shape than it was prepared for, an input that the host binds itself, or a depth texture, which
    /// only a host can fill.
    pub fn upload(&self, queue: &wgpu::Queue, name: &str, array: &Array) -> Result<(), Problem> {
        let slot = slot_named(&self.plan, name)?;
        let Some(index) = self.own_memory(slot, name, array)? else { return Ok(()) };
        match &self.memories[index] {
            Memory::Buffer(buffer) => write_words(queue, buffer, array.words()),
            Memory::Texture(texture) if texture.format() == wgpu::TextureFormat::Depth32Float => {
                return Err(Problem::new(Kind::Unsupported, "a depth texture cannot be uploaded")
                    .port(name)
                    .remedy("bind a depth texture of the host in Externals"));
            }
            Memory::Texture(texture) if array.bytes() > 0 => {
                let size = texture.size();
                let layout = wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some((array.words().len() / size.height as usize * 4) as u32),
                    rows_per_image: Some(size.height),
                };
                queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(array.words()), layout, size);
            }
            Memory::Texture(_) => {}
        }
        Ok(())
    }

    /// As [`Prepared::upload`] for the session, which may submit: takes depth textures too, by drawing them.
    pub(crate) fn upload_any(&self, queue: &wgpu::Queue, slot: SlotId, array: &Array) -> Result<(), Problem> {
        let name = &self.plan.slots[slot].name;
        let is_depth = self.layout.slot(slot).is_some_and(|part| part.storage == Storage::DepthTexture);
        match self.own_memory(slot, name, array)?.map(|index| &self.memories[index]) {
            Some(Memory::Texture(texture)) if is_depth && array.bytes() > 0 => scoped(&self.device, || {
                draw_depth(&self.device, queue, texture, array);
                Ok(())
            }),
            _ if is_depth => Ok(()),
            _ => self.upload(queue, name, array),
        }
    }

    /// The memory behind an input; none when no wgpu node reads it.
    fn own_memory(&self, slot: SlotId, name: &str, array: &Array) -> Result<Option<usize>, Problem> {
        let problem = |text: &str| Problem::new(Kind::BadValue, text).port(name);
        if self.plan.slots[slot].producer != Producer::Input {
            return Err(problem("only graph inputs can be uploaded"));
        }
        if self.shapes.0[slot] != array.shape() {
            return Err(problem("another shape than the graph was prepared for")
                .expected(format!("{:?}", self.shapes.0[slot]))
                .found(format!("{:?}", array.shape())));
        }
        match self.layout.slot(slot).map(|part| part.home) {
            None => Ok(None),
            Some(Home::Own(index)) => Ok(Some(index)),
            Some(Home::External(_)) => Err(problem("this input is bound by the host")),
        }
    }

    /// Fills everything that is not an input with all bits set, so that a read of what nobody wrote shows. Depth is left alone.
    pub(crate) fn poison(&self, queue: &wgpu::Queue) {
        let inputs: Vec<Home> =
            self.plan.inputs().filter_map(|(slot, _)| self.layout.slot(slot)).map(|part| part.home).collect();
        for (index, (memory, want)) in self.memories.iter().zip(&self.layout.wants).enumerate() {
            let garbage = vec![u32::MAX; (want.bytes / 4) as usize];
            match memory {
                _ if inputs.contains(&Home::Own(index)) => {}
                Memory::Buffer(buffer) => write_words(queue, buffer, &garbage),
                Memory::Texture(texture) if want.storage != Storage::DepthTexture => {
                    let layout = wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some((garbage.len() / want.extent[1] as usize * 4) as u32),
                        rows_per_image: Some(want.extent[1]),
                    };
                    let bytes = bytemuck::cast_slice(&garbage);
                    queue.write_texture(texture.as_image_copy(), bytes, layout, texture.size());
                }
                Memory::Texture(_) => {}
            }
        }
    }
}

fn write_words(queue: &wgpu::Queue, buffer: &wgpu::Buffer, words: &[u32]) {
    for (piece, words) in words.chunks(PIECE_WORDS).enumerate() {
        queue.write_buffer(buffer, (piece * PIECE_WORDS * 4) as u64, bytemuck::cast_slice(words));
    }
}

/// No copy to a depth texture exists, so a triangle over each layer writes it.
const DEPTH_WGSL: &str = "
@group(0) @binding(0) var<storage, read> depth: array<f32>;
@group(0) @binding(1) var<uniform> width: vec4<u32>;
@vertex fn corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
@fragment fn texel(@builtin(position) at: vec4<f32>) -> @builtin(frag_depth) f32 {
    return depth[u32(at.y) * width.x + u32(at.x)];
}";

fn draw_depth(device: &wgpu::Device, queue: &wgpu::Queue, texture: &wgpu::Texture, array: &Array) {
    let label = Some("depth upload");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label,
        source: wgpu::ShaderSource::Wgsl(DEPTH_WGSL.into()),
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: texture.format(),
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Always),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    });
    let buffer = |usage, size| {
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        device.create_buffer(&wgpu::BufferDescriptor { label, size, usage, mapped_at_creation: false })
    };
    let layer_words = texture.width() as usize * texture.height() as usize;
    let depth = buffer(wgpu::BufferUsages::STORAGE, layer_words as u64 * 4);
    let width = buffer(wgpu::BufferUsages::UNIFORM, 16);
    queue.write_buffer(&width, 0, bytemuck::cast_slice(&[texture.width(), 0, 0, 0]));
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: depth.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: width.as_entire_binding() },
        ],
    });
    for (layer, words) in array.words().chunks(layer_words).enumerate() {
        write_words(queue, &depth, words);
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer as u32,
            array_layer_count: Some(1),
            ..Default::default()
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        // A submission for each layer: writes to the one staging buffer take effect between submissions only.
        queue.submit([encoder.finish()]);
    }
}
