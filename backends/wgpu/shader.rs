//! WGSL as naga sees it, and the comparison of what an entry point binds and does with what the recipe says.

use naga::valid::{Capabilities, GlobalUse, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, ImageClass, ImageDimension, ScalarKind, StorageAccess, TypeInner};
use shadowgraph_core::port::Storage;
use shadowgraph_core::record::Shader;

/// A parsed and validated module.
#[derive(Debug)]
pub(crate) struct Module {
    naga: naga::Module,
    info: ModuleInfo,
}

/// What the recipe binds at one place, without saying to which memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// A uniform buffer of this many bytes.
    Uniform(u32),
    /// A storage buffer that is only read.
    Read,
    /// A storage buffer that is written.
    ReadWrite,
    /// A texture of this kind.
    Texture(Storage),
}

/// Entry points of one pipeline, each with its stage.
pub(crate) type Entries<'a> = [(&'a str, naga::ShaderStage)];

/// The joined pieces of a shader.
pub(crate) fn join(shader: &Shader) -> String {
    shader.pieces.join("\n")
}

impl Module {
    /// Parses and validates; panics with naga's message, and `who`, on WGSL that is wrong.
    pub fn new(source: &str, who: &str) -> Self {
        let naga = match naga::front::wgsl::parse_str(source) {
            Ok(module) => module,
            Err(error) => panic!("{who}: the kernel does not parse: {}", error.emit_to_string(source)),
        };
        let info = match Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&naga) {
            Ok(info) => info,
            Err(error) => panic!("{who}: the kernel is not valid: {}", error.emit_to_string(source)),
        };
        Self { naga, info }
    }

    /// Stages that use each binding of `bind`. Panics, with `who` and the binding, where the entry points bind or do anything
    /// else than the recipe says.
    pub fn visibility(&self, who: &str, entries: &Entries, bind: &[Class]) -> Vec<wgpu::ShaderStages> {
        let mut visible = vec![wgpu::ShaderStages::NONE; bind.len()];
        for (entry, stage) in entries {
            let at = self.naga.entry_points.iter().position(|point| point.name == *entry && point.stage == *stage);
            let Some(index) = at else { panic!("{who}: the kernel has no {stage:?} entry point {entry}") };
            let info = self.info.get_entry_point(index);
            for (handle, variable) in self.naga.global_variables.iter() {
                let (Some(place), used) = (variable.binding, info[handle]) else { continue };
                if used.is_empty() {
                    continue;
                }
                let name = variable.name.as_deref().unwrap_or("?");
                let class = bind.get(place.binding as usize).filter(|_| place.group == 0);
                let Some(class) = class else {
                    panic!(
                        "{who}: {entry} uses @group({}) @binding({}) {name}, which the recipe does not bind",
                        place.group, place.binding
                    )
                };
                if let Err(found) = self.check(variable, *class) {
                    panic!("{who}: binding {} {name}: the recipe says {class:?}, the kernel {found}", place.binding);
                }
                visible[place.binding as usize] |= match stage {
                    naga::ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
                    naga::ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
                    _ => wgpu::ShaderStages::COMPUTE,
                };
            }
        }
        for (binding, class) in bind.iter().enumerate() {
            self.check_use(who, binding, *class);
        }
        visible
    }

    /// Whether a variable is what the recipe binds there.
    fn check(&self, variable: &naga::GlobalVariable, class: Class) -> Result<(), String> {
        let inner = &self.naga.types[variable.ty].inner;
        match (variable.space, class) {
            (AddressSpace::Uniform, Class::Uniform(bytes)) => {
                let size = inner.size(self.naga.to_ctx());
                if size <= bytes { Ok(()) } else { Err(format!("a uniform of {size} bytes")) }
            }
            (AddressSpace::Storage { access }, Class::Read) if !access.contains(StorageAccess::STORE) => Ok(()),
            (AddressSpace::Storage { access }, Class::ReadWrite) if access.contains(StorageAccess::STORE) => Ok(()),
            (AddressSpace::Handle, Class::Texture(storage)) if fits(inner, storage) => Ok(()),
            (space, _) => Err(format!("{space:?} {inner:?}")),
        }
    }

    /// One set of bindings may serve several entry points, so an entry may leave a binding alone; but some entry point must use
    /// it, and one that the recipe calls written must be written by some.
    fn check_use(&self, who: &str, binding: usize, class: Class) {
        let mut used = GlobalUse::empty();
        for (index, _) in self.naga.entry_points.iter().enumerate() {
            for (handle, variable) in self.naga.global_variables.iter() {
                if variable.binding.is_some_and(|place| place.binding as usize == binding) {
                    used |= self.info.get_entry_point(index)[handle];
                }
            }
        }
        assert!(!used.is_empty(), "{who}: binding {binding}: the recipe says {class:?}, no entry point uses it");
        if class == Class::ReadWrite {
            let writes = used.intersects(GlobalUse::WRITE | GlobalUse::ATOMIC);
            assert!(writes, "{who}: binding {binding}: the recipe says ReadWrite, no entry point writes it");
        }
    }
}

fn fits(inner: &TypeInner, storage: Storage) -> bool {
    let TypeInner::Image { dim: ImageDimension::D2, arrayed, class } = *inner else { return false };
    match storage {
        Storage::DepthTexture => arrayed && class == ImageClass::Depth { multi: false },
        Storage::Rgba32Float => !arrayed && class == ImageClass::Sampled { kind: ScalarKind::Float, multi: false },
        Storage::R32Uint => !arrayed && class == ImageClass::Sampled { kind: ScalarKind::Uint, multi: false },
        Storage::Buffer => false,
    }
}
