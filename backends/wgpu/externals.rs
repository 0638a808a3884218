//! What a host binds of its own: buffers and textures for graph inputs and outputs, by name.

use crate::pool::{Home, Memory, Part, format};
use crate::prepare::Prepared;
use shadowgraph_core::plan::{Plan, SlotId};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};

/// The host's resources for one recording.
#[derive(Clone, Debug, Default)]
pub struct Externals {
    bound: Vec<(String, Memory, u64)>,
}

impl Externals {
    /// Nothing bound.
    pub fn new() -> Self {
        Self::default()
    }
    /// Binds a buffer to graph input or output `name`. Its usage needs STORAGE, and COPY_DST where the graph fills it with zero.
    pub fn buffer(self, name: impl Into<String>, buffer: &wgpu::Buffer) -> Self {
        self.buffer_at(name, buffer, 0)
    }
    /// As [`Externals::buffer`], from byte `offset`, a multiple of the device's storage alignment.
    pub fn buffer_at(mut self, name: impl Into<String>, buffer: &wgpu::Buffer, offset: u64) -> Self {
        self.bound.push((name.into(), Memory::Buffer(buffer.clone()), offset));
        self
    }
    /// Binds a texture. Its usage needs TEXTURE_BINDING where the graph reads it, RENDER_ATTACHMENT where it draws to it.
    pub fn texture(mut self, name: impl Into<String>, texture: &wgpu::Texture) -> Self {
        self.bound.push((name.into(), Memory::Texture(texture.clone()), 0));
        self
    }
}

/// The slot a host means by `name`: an input or slot of that name, else the graph output of that name.
///
/// # Errors
/// There is none; the problem lists the names of inputs and outputs.
pub fn slot_named(plan: &Plan, name: &str) -> Result<SlotId, Problem> {
    let output = || plan.outputs.iter().find(|(output, _)| output == name).map(|(_, slot)| *slot);
    plan.slot(name).or_else(output).ok_or_else(|| {
        let mut names: Vec<&str> = plan.inputs().map(|(_, slot)| slot.name.as_str()).collect();
        names.extend(plan.outputs.iter().map(|(name, _)| name.as_str()));
        Problem::new(Kind::UnknownName, "the graph has no such input or output")
            .port(name)
            .expected(format!("one of {}", names.join(", ")))
    })
}

/// The host's resources by slot, checked.
pub(crate) struct Bound<'a> {
    pub prepared: &'a Prepared,
    by_slot: Vec<Option<(Memory, u64)>>,
}

impl<'a> Bound<'a> {
    /// Looks every name up, and checks kind, size and format against what the graph was prepared for.
    pub fn new(prepared: &'a Prepared, externals: &Externals) -> Result<Self, Problem> {
        let mut by_slot = vec![None; prepared.plan.slots.len()];
        for (name, memory, offset) in &externals.bound {
            let slot = slot_named(&prepared.plan, name)?;
            match prepared.layout.slot(slot) {
                Some(part) if part.home == Home::External(slot) => check(name, part, memory, *offset)?,
                // No wgpu node touches it: nothing would read or write it.
                None => {}
                Some(_) => {
                    return Err(Problem::new(Kind::BadValue, "bound by the host, but not prepared as external")
                        .port(name)
                        .remedy("name it in Request::external"));
                }
            }
            by_slot[slot] = Some((memory.clone(), *offset));
        }
        for (slot, value) in by_slot.iter().enumerate() {
            let external = prepared.layout.slot(slot).is_some_and(|part| part.home == Home::External(slot));
            if external && value.is_none() {
                return Err(Problem::new(Kind::Missing, "prepared as external, but the host binds nothing")
                    .port(&prepared.plan.slots[slot].name)
                    .remedy("bind it in Externals"));
            }
        }
        Ok(Self { prepared, by_slot })
    }

    /// Nothing bound by a host: panics later if something should have been.
    pub fn none(prepared: &'a Prepared) -> Self {
        Self { prepared, by_slot: Vec::new() }
    }

    fn memory(&self, part: &Part) -> (&Memory, u64) {
        match part.home {
            Home::Own(index) => (&self.prepared.memories[index], 0),
            Home::External(slot) => match &self.by_slot[slot] {
                Some((memory, offset)) => (memory, *offset),
                None => unreachable!("external slot {slot} was checked to be bound"),
            },
        }
    }
    /// The buffer of a part and where in it the part starts, bytes.
    pub fn buffer(&self, part: &Part) -> (&wgpu::Buffer, u64) {
        match self.memory(part) {
            (Memory::Buffer(buffer), offset) => (buffer, offset),
            (Memory::Texture(_), _) => unreachable!("a buffer command names {part:?}, which is a texture"),
        }
    }
    /// The texture of a part.
    pub fn texture(&self, part: &Part) -> &wgpu::Texture {
        match self.memory(part) {
            (Memory::Texture(texture), _) => texture,
            (Memory::Buffer(_), _) => unreachable!("a texture command names {part:?}, which is a buffer"),
        }
    }
}

fn check(name: &str, part: &Part, memory: &Memory, offset: u64) -> Result<(), Problem> {
    let problem = |expected: String, found: String| {
        Err(Problem::new(Kind::BadValue, "the host's resource does not fit").port(name).expected(expected).found(found))
    };
    let needed = part.bytes();
    match memory {
        Memory::Buffer(buffer) if part.storage == Storage::Buffer => {
            let size = buffer.size().saturating_sub(offset);
            if !buffer.usage().contains(wgpu::BufferUsages::STORAGE) {
                return problem("a buffer with usage STORAGE".into(), format!("{:?}", buffer.usage()));
            }
            if size < needed { problem(format!("{needed} bytes"), format!("{size} bytes")) } else { Ok(()) }
        }
        Memory::Texture(texture) if part.storage != Storage::Buffer => {
            let text = |format, [width, height, layers]: [u32; 3]| format!("{format:?} {width}x{height}x{layers}");
            let wanted = (format(part.storage), part.extent());
            let found = (texture.format(), [texture.width(), texture.height(), texture.depth_or_array_layers()]);
            if wanted == found { Ok(()) } else { problem(text(wanted.0, wanted.1), text(found.0, found.1)) }
        }
        Memory::Buffer(_) => problem("a texture".into(), "a buffer".into()),
        Memory::Texture(_) => problem("a buffer".into(), "a texture".into()),
    }
}
