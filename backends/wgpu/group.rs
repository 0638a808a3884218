//! Bind groups: made once, or at each recording where the host binds something of its own.

use crate::externals::Bound;
use crate::pool::{Home, Part};
use crate::prepare::Prepared;
use crate::shader::Class;
use shadowgraph_core::port::Storage;
use shadowgraph_core::record::Bind;
use std::ops::Range;

/// Resources of one command. Made once when none of them is the host's, at each recording otherwise.
#[derive(Debug)]
pub(crate) struct Group {
    layout: wgpu::BindGroupLayout,
    entries: Vec<Entry>,
    fixed: Option<wgpu::BindGroup>,
}

#[derive(Debug)]
enum Entry {
    Uniform(wgpu::Buffer),
    Buffer(Part),
    Words(Part, Range<usize>),
    Texture(Part),
}

impl Group {
    /// The resources `bind` of the command called `who`, with what [`crate::command::classes`] found behind them. Uniforms are
    /// uploaded here.
    pub fn new(
        prepared: &Prepared,
        queue: &wgpu::Queue,
        who: &str,
        layout: wgpu::BindGroupLayout,
        bind: &[Bind],
        parts: Vec<(Class, Option<Part>)>,
    ) -> Self {
        let external = parts.iter().flat_map(|(_, part)| part).any(|part| matches!(part.home, Home::External(_)));
        let entry = |(bind, (class, part)): (&Bind, (Class, Option<Part>))| match (bind, class, part) {
            (_, Class::Texture(_), Some(part)) => Entry::Texture(part),
            (Bind::UniformOf(_, words), _, Some(part)) => Entry::Words(part, words.clone()),
            (_, _, Some(part)) => Entry::Buffer(part),
            (Bind::Uniform(words), Class::Uniform(bytes), None) => {
                Entry::Uniform(uniform(&prepared.device, queue, words, bytes))
            }
            (bind, ..) => unreachable!("{who}: {bind:?} without memory"),
        };
        let mut group = Self { layout, entries: bind.iter().zip(parts).map(entry).collect(), fixed: None };
        if !external {
            group.fixed = Some(group.make(&Bound::none(prepared), who));
        }
        group
    }

    /// The bind group for this recording.
    pub fn get(&self, bound: &Bound, who: &str) -> wgpu::BindGroup {
        self.fixed.clone().unwrap_or_else(|| self.make(bound, who))
    }

    fn make(&self, bound: &Bound, who: &str) -> wgpu::BindGroup {
        let views: Vec<Option<wgpu::TextureView>> = self
            .entries
            .iter()
            .map(|entry| if let Entry::Texture(part) = entry { Some(view(bound, part)) } else { None })
            .collect();
        let entries: Vec<_> = self
            .entries
            .iter()
            .zip(&views)
            .enumerate()
            .map(|(binding, (entry, view))| wgpu::BindGroupEntry {
                binding: binding as u32,
                resource: match (entry, view) {
                    (Entry::Uniform(buffer), _) => buffer.as_entire_binding(),
                    (Entry::Buffer(part), _) => {
                        let (buffer, offset) = bound.buffer(part);
                        let size = wgpu::BufferSize::new(part.bytes());
                        wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset, size })
                    }
                    (Entry::Words(part, words), _) => {
                        let (buffer, offset) = bound.buffer(part);
                        let size = wgpu::BufferSize::new(words.len() as u64 * 4);
                        let offset = offset + words.start as u64 * 4;
                        wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset, size })
                    }
                    (Entry::Texture(_), Some(view)) => wgpu::BindingResource::TextureView(view),
                    (Entry::Texture(_), None) => unreachable!("every texture has a view"),
                },
            })
            .collect();
        let descriptor = wgpu::BindGroupDescriptor { label: Some(who), layout: &self.layout, entries: &entries };
        bound.prepared.device.create_bind_group(&descriptor)
    }
}

fn view(bound: &Bound, part: &Part) -> wgpu::TextureView {
    let dimension = match part.storage {
        Storage::DepthTexture => wgpu::TextureViewDimension::D2Array,
        _ => wgpu::TextureViewDimension::D2,
    };
    bound.texture(part).create_view(&wgpu::TextureViewDescriptor { dimension: Some(dimension), ..Default::default() })
}

fn uniform(device: &wgpu::Device, queue: &wgpu::Queue, words: &[u32], bytes: u32) -> wgpu::Buffer {
    let mut words = words.to_vec();
    words.resize(bytes as usize / 4, 0);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("uniform"),
        size: bytes.into(),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytemuck::cast_slice(&words));
    buffer
}
