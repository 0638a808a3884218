//! Memory of a plan: which slots, scratch and counters share which buffer or texture. Laid out without a device, so that sizes
//! are checked before anything is allocated.
//!
//! Transients with equal alias numbers share memory, sized by the largest; so does the scratch memory of different nodes.

use crate::recipe::{Recipe, named, uniforms};
use shadowgraph_core::plan::{Plan, Shapes, SlotId};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Command, Groups, Target};
use std::collections::HashMap;

/// Smallest buffer binding, bytes: a value without rows still has something to bind.
const SMALLEST_BYTES: u64 = 16;

/// Where a value lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Home {
    /// Memory of the pool, by index.
    Own(usize),
    /// Whatever the host binds to this slot.
    External(SlotId),
}

/// What a target of a recipe names.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub home: Home,
    pub storage: Storage,
    pub shape: Vec<usize>,
}

impl Part {
    /// Number of words of the value.
    pub fn words(&self) -> usize {
        self.shape.iter().product()
    }
    /// Size of its binding, bytes.
    pub fn bytes(&self) -> u64 {
        bytes(self.storage, &self.shape)
    }
    /// Width, height and layers of a texture, each at least 1.
    pub fn extent(&self) -> [u32; 3] {
        extent(self.storage, &self.shape)
    }
}

fn bytes(storage: Storage, shape: &[usize]) -> u64 {
    let words = match storage {
        Storage::Buffer => shape.iter().product::<usize>() as u64,
        Storage::Rgba32Float => 4 * extent(storage, shape).map(u64::from).iter().product::<u64>(),
        Storage::DepthTexture | Storage::R32Uint => extent(storage, shape).map(u64::from).iter().product(),
    };
    if words == 0 { SMALLEST_BYTES } else { words * 4 }
}

fn extent(storage: Storage, shape: &[usize]) -> [u32; 3] {
    let dim = |axis: usize| shape.get(axis).copied().unwrap_or(1).clamp(1, u32::MAX as usize) as u32;
    match storage {
        Storage::Buffer => [dim(0), 1, 1],
        Storage::DepthTexture => [dim(2), dim(1), dim(0)],
        Storage::Rgba32Float | Storage::R32Uint => [dim(1), dim(0), 1],
    }
}

/// One buffer or texture to allocate.
#[derive(Clone, Debug)]
pub(crate) struct Want {
    /// Label: the first value that lives here.
    pub label: String,
    /// Node and port or scratch that needs the most, for errors.
    owner: (Option<String>, String),
    pub storage: Storage,
    pub extent: [u32; 3],
    pub bytes: u64,
    pub indirect: bool,
    pub uniform: bool,
}

/// The memory of a plan.
#[derive(Debug, Default)]
pub(crate) struct Layout {
    pub wants: Vec<Want>,
    slots: Vec<Option<Part>>,
    scratch: Vec<Vec<Part>>,
    counters: Vec<Option<Part>>,
}

/// Values of one key share memory. Textures share only with textures of their very size: attachments must match exactly.
type Key = (&'static str, usize, Option<(Storage, [u32; 3])>);

impl Layout {
    /// Lays out everything that the wgpu nodes of `plan` touch; `external` slots live with the host.
    pub fn new(plan: &Plan, shapes: &Shapes, recipes: &[Option<Recipe>], external: &[SlotId], alias: bool) -> Self {
        let mut layout = Self { slots: vec![None; plan.slots.len()], ..Self::default() };
        let mut known: HashMap<Key, usize> = HashMap::new();
        for (index, recipe) in recipes.iter().enumerate() {
            let node = &plan.nodes[index];
            let ports = if recipe.is_some() { node.inputs.iter().chain(&node.outputs) } else { [].iter().chain(&[]) };
            for (_, slot_id) in ports {
                if layout.slots[*slot_id].is_some() {
                    continue;
                }
                let slot = &plan.slots[*slot_id];
                let (storage, shape) = (slot.storage(), shapes.0[*slot_id].clone());
                let number = if alias { slot.alias } else { *slot_id };
                let home = if external.contains(slot_id) {
                    Home::External(*slot_id)
                } else {
                    let owner = match slot.name.split_once('.') {
                        Some((node, port)) => (Some(node.into()), port.into()),
                        None => (None, slot.name.clone()),
                    };
                    layout.enter(&mut known, ("slot", number), &slot.name, owner, storage, &shape)
                };
                layout.slots[*slot_id] = Some(Part { home, storage, shape });
            }
            let mut scratch = Vec::new();
            for (place, piece) in recipe.iter().flat_map(|recipe| &recipe.scratch).enumerate() {
                let owner = (Some(node.id.clone()), piece.label.into());
                let label = format!("{}.{}", node.id, piece.label);
                let home = layout.enter(&mut known, ("scratch", place), &label, owner, piece.storage, &piece.shape);
                scratch.push(Part { home, storage: piece.storage, shape: piece.shape.clone() });
            }
            layout.scratch.push(scratch);
            let counters = recipe.is_some().then_some(node.pass.counters.len()).filter(|count| *count > 0);
            let counters = counters.map(|count| {
                let owner = (Some(node.id.clone()), "counters".into());
                let label = format!("{}.counters", node.id);
                let home = layout.enter(&mut known, ("counters", index), &label, owner, Storage::Buffer, &[count]);
                Part { home, storage: Storage::Buffer, shape: vec![count] }
            });
            layout.counters.push(counters);
        }
        layout.mark_uses(plan, recipes);
        layout
    }

    fn enter(
        &mut self,
        known: &mut HashMap<Key, usize>,
        (family, number): (&'static str, usize),
        label: &str,
        owner: (Option<String>, String),
        storage: Storage,
        shape: &[usize],
    ) -> Home {
        let (extent, bytes) = (extent(storage, shape), bytes(storage, shape));
        let key = (family, number, (storage != Storage::Buffer).then_some((storage, extent)));
        let index = *known.entry(key).or_insert_with(|| {
            let want = Want {
                label: label.into(),
                owner: owner.clone(),
                storage,
                extent,
                bytes,
                indirect: false,
                uniform: false,
            };
            self.wants.push(want);
            self.wants.len() - 1
        });
        let want = &mut self.wants[index];
        if bytes > want.bytes {
            (want.bytes, want.owner) = (bytes, owner);
        }
        Home::Own(index)
    }

    /// Marks what dispatches take their size from, and what is bound as a uniform.
    fn mark_uses(&mut self, plan: &Plan, recipes: &[Option<Recipe>]) {
        for (node, recipe) in recipes.iter().enumerate() {
            for command in recipe.iter().flat_map(|recipe| &recipe.commands) {
                for (target, _) in named(command) {
                    let home = self.part(plan, node, target).home;
                    let is_arguments = matches!(command, Command::Dispatch(dispatch)
                        if matches!(dispatch.groups, Groups::Indirect(of, _) if of == target));
                    let is_uniform = uniforms(command).any(|of| of == target);
                    if let Home::Own(index) = home {
                        self.wants[index].indirect |= is_arguments;
                        self.wants[index].uniform |= is_uniform;
                    }
                }
            }
        }
    }

    /// What `target` of node `node` names: [`crate::recipe`] checked that it is there.
    pub fn part(&self, plan: &Plan, node: usize, target: Target) -> &Part {
        let found = match target {
            Target::Port(port) => {
                let mut ports = plan.nodes[node].inputs.iter().chain(&plan.nodes[node].outputs);
                ports.find(|(name, _)| *name == port).and_then(|(_, slot)| self.slots[*slot].as_ref())
            }
            Target::Scratch(index) => self.scratch[node].get(index),
            Target::Counters => self.counters[node].as_ref(),
        };
        let Some(part) = found else {
            unreachable!("node {} names {target:?}, which it does not have", plan.nodes[node].id)
        };
        part
    }

    /// Where a slot lives; none when no wgpu node touches it.
    pub fn slot(&self, slot: SlotId) -> Option<&Part> {
        self.slots[slot].as_ref()
    }

    /// The counters of a node, if its pass has some.
    pub fn counters(&self, node: usize) -> Option<&Part> {
        self.counters[node].as_ref()
    }

    /// Scratch memory of a node.
    pub fn scratch(&self, node: usize) -> &[Part] {
        &self.scratch[node]
    }

    /// Size of all of it, bytes.
    pub fn bytes(&self) -> u64 {
        self.wants.iter().map(|want| want.bytes).sum()
    }

    /// Whether a device with `limits` can hold it, and whether it stays within `budget` bytes.
    pub fn check(&self, limits: &wgpu::Limits, budget: Option<u64>) -> Result<(), Problem> {
        for want in &self.wants {
            let side = want.extent[0].max(want.extent[1]);
            if want.storage == Storage::Buffer {
                let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
                if want.bytes > most {
                    return Err(want.overflow(format!("a buffer of {} bytes", want.bytes), format!("{most} bytes")));
                }
            } else if side > limits.max_texture_dimension_2d {
                let most = limits.max_texture_dimension_2d;
                return Err(want.overflow(format!("a texture side of {side}"), format!("{most}")));
            } else if want.extent[2] > limits.max_texture_array_layers {
                let most = limits.max_texture_array_layers;
                return Err(want.overflow(format!("{} texture layers", want.extent[2]), format!("{most}")));
            }
        }
        match (budget, self.wants.iter().max_by_key(|want| want.bytes)) {
            (Some(budget), Some(largest)) if self.bytes() > budget => Err(largest.overflow(
                format!("{} bytes for the whole graph, {} of them here", self.bytes(), largest.bytes),
                format!("{budget} bytes"),
            )),
            _ => Ok(()),
        }
    }
}

impl Want {
    fn overflow(&self, needed: String, available: String) -> Problem {
        let problem = Problem::new(Kind::Overflow, "more device memory is needed than there is")
            .port(&self.owner.1)
            .expected(format!("room for {needed}"))
            .found(format!("at most {available}"))
            .remedy("use a smaller picture or resolution, or the CPU backend");
        match &self.owner.0 {
            Some(node) => problem.node(node),
            None => problem,
        }
    }
}

/// One allocated piece of memory.
#[derive(Clone, Debug)]
pub(crate) enum Memory {
    Buffer(wgpu::Buffer),
    Texture(wgpu::Texture),
}

/// The texture format of a storage; panics for buffers.
pub(crate) fn format(storage: Storage) -> wgpu::TextureFormat {
    match storage {
        Storage::DepthTexture => wgpu::TextureFormat::Depth32Float,
        Storage::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        Storage::R32Uint => wgpu::TextureFormat::R32Uint,
        Storage::Buffer => unreachable!("a buffer has no texture format"),
    }
}

/// Allocates every want of `layout`.
pub(crate) fn allocate(device: &wgpu::Device, layout: &Layout) -> Vec<Memory> {
    use wgpu::{BufferUsages, TextureUsages};
    let one = |want: &Want| {
        let label = Some(want.label.as_str());
        if want.storage == Storage::Buffer {
            let mut usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
            usage.set(BufferUsages::INDIRECT, want.indirect);
            usage.set(BufferUsages::UNIFORM, want.uniform);
            let size = want.bytes;
            return Memory::Buffer(device.create_buffer(&wgpu::BufferDescriptor {
                label,
                size,
                usage,
                mapped_at_creation: false,
            }));
        }
        let [width, height, depth_or_array_layers] = want.extent;
        let mut usage = TextureUsages::TEXTURE_BINDING | TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
        usage.set(TextureUsages::COPY_DST, want.storage != Storage::DepthTexture);
        Memory::Texture(device.create_texture(&wgpu::TextureDescriptor {
            label,
            size: wgpu::Extent3d { width, height, depth_or_array_layers },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: format(want.storage),
            usage,
            view_formats: &[],
        }))
    };
    layout.wants.iter().map(one).collect()
}
