//! WGSL as naga sees it, and the comparison of what an entry point binds and does with what the recipe says.

use naga::valid::{Capabilities, GlobalUse, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, ImageClass, ImageDimension, ScalarKind, StorageAccess, TypeInner};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
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

/// A mistake of the pass whose command is `who` (`node/label`).
pub(crate) fn bad_pass(who: &str, message: impl Into<String>) -> Problem {
    Problem::new(Kind::BadPass, message).node(who)
}

impl Module {
    /// Parses and validates.
    ///
    /// # Errors
    /// WGSL that is wrong, with naga's words and place.
    pub fn new(source: &str, who: &str) -> Result<Self, Problem> {
        let wrong = |what: &str, text: String| bad_pass(who, format!("the kernel {what}: {}", text.trim_end()));
        let naga = naga::front::wgsl::parse_str(source)
            .map_err(|error| wrong("does not parse", error.emit_to_string(source)))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(&naga)
            .map_err(|error| wrong("is not valid", error.emit_to_string(source)))?;
        Ok(Self { naga, info })
    }

    /// Stages that use each binding of `bind`.
    ///
    /// # Errors
    /// Entry points that bind or do anything else than the recipe says, with `who` and the binding.
    pub fn visibility(&self, who: &str, entries: &Entries, bind: &[Class]) -> Result<Vec<wgpu::ShaderStages>, Problem> {
        let mut visible = vec![wgpu::ShaderStages::NONE; bind.len()];
        for (entry, stage) in entries {
            let at = self.naga.entry_points.iter().position(|point| point.name == *entry && point.stage == *stage);
            let Some(index) = at else {
                let points = self.naga.entry_points.iter().map(|point| point.name.as_str()).collect::<Vec<_>>();
                return Err(
                    bad_pass(who, format!("the kernel has no {stage:?} entry point {entry}")).found(points.join(", "))
                );
            };
            let info = self.info.get_entry_point(index);
            for (handle, variable) in self.naga.global_variables.iter() {
                let (Some(place), used) = (variable.binding, info[handle]) else { continue };
                if used.is_empty() {
                    continue;
                }
                let name = variable.name.as_deref().unwrap_or("?");
                let class = bind.get(place.binding as usize).filter(|_| place.group == 0);
                let Some(class) = class else {
                    let at = format!("@group({}) @binding({})", place.group, place.binding);
                    return Err(bad_pass(who, format!("{entry} uses {at} {name}, which the recipe does not bind")));
                };
                self.check(variable, *class).map_err(|found| {
                    let at = format!("binding {} {name}", place.binding);
                    bad_pass(who, format!("{at}: the recipe says {class:?}, the kernel {found}"))
                })?;
                visible[place.binding as usize] |= match stage {
                    naga::ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
                    naga::ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
                    _ => wgpu::ShaderStages::COMPUTE,
                };
            }
        }
        for (binding, class) in bind.iter().enumerate() {
            self.check_use(who, binding, *class)?;
        }
        Ok(visible)
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
    fn check_use(&self, who: &str, binding: usize, class: Class) -> Result<(), Problem> {
        let mut used = GlobalUse::empty();
        for (index, _) in self.naga.entry_points.iter().enumerate() {
            for (handle, variable) in self.naga.global_variables.iter() {
                if variable.binding.is_some_and(|place| place.binding as usize == binding) {
                    used |= self.info.get_entry_point(index)[handle];
                }
            }
        }
        let idle = if used.is_empty() {
            "uses"
        } else if class == Class::ReadWrite && !used.intersects(GlobalUse::WRITE | GlobalUse::ATOMIC) {
            "writes"
        } else {
            return Ok(());
        };
        Err(bad_pass(who, format!("binding {binding}: the recipe says {class:?}, no entry point {idle} it")))
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
