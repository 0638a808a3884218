//! What a pass is: plain data and functions.

use crate::cpu::CpuFn;
use crate::param::ParamSpec;
use crate::record::GpuFn;
use crate::size::SizeFn;
use crate::stage::Stage;

/// How the outputs of two passes of one stage, or of the two backends of one pass, must compare on equal inputs.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Contract {
    /// Equal bits.
    Exact,
    /// Equal within this absolute bound, in the port's unit.
    Within(f32),
    /// Equal as sets within each cell: order in a list is unspecified.
    Sets,
    /// Every (cell, caster) pair that matters is present; more are allowed.
    Superset,
    /// Wrong bits against exact predicates at most this share of all bits.
    WrongBits(f32),
    /// An approximation: charted, never compared bit by bit.
    Approximate,
}

/// A device feature a pass cannot do without. Names are those of WebGPU and wgpu.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Feature {
    /// Rasterisation of every touched texel by the device.
    ConservativeRasterization,
    /// Indirect draws and dispatches whose arguments kernels wrote.
    IndirectExecution,
    /// Storage buffers written by fragment shaders.
    FragmentWritableStorage,
}

/// A count that a pass keeps while it runs: shown in the run's record, and the source of overflow errors.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Counter {
    /// Name in records.
    pub name: &'static str,
    /// One line.
    pub doc: &'static str,
    /// What the count means for the run.
    pub kind: CounterKind,
}

/// Meaning of a counter.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CounterKind {
    /// Information.
    Info,
    /// Information that the CPU function alone keeps: on a GPU it would cost.
    OnCpu,
    /// The largest of something: over several runs the largest counts, not the sum.
    Most,
    /// Rows of this output port that were needed; more than its capacity is an overflow, and the run can be grown.
    Rows(&'static str),
    /// Must be zero; anything else is an error with this remedy.
    MustBeZero(&'static str),
}

impl CounterKind {
    /// What two runs over different parts counted together.
    pub fn joined(self, one: u64, other: u64) -> u64 {
        if self == Self::Most { one.max(other) } else { one + other }
    }
}

/// One way to do a stage.
#[derive(Clone, Copy)]
pub struct Pass {
    /// Name, unique within its stage; the folder's name.
    pub name: &'static str,
    /// What it implements.
    pub stage: &'static Stage,
    /// One sentence.
    pub doc: &'static str,
    /// Paper, section, equation.
    pub source: &'static str,
    /// Optional and required input ports of the stage that this pass never reads. They do not keep nodes alive.
    pub ignores: &'static [&'static str],
    /// Parameters.
    pub params: &'static [ParamSpec],
    /// Counters.
    pub counters: &'static [Counter],
    /// How its outputs compare with those of the exact way.
    pub contract: Contract,
    /// Device features the GPU recipe needs.
    pub features: &'static [Feature],
    /// Output shapes.
    pub size: SizeFn,
    /// CPU function, if it makes sense there.
    pub cpu: Option<CpuFn>,
    /// GPU recipe, if it makes sense there.
    pub gpu: Option<GpuFn>,
}

impl Pass {
    /// Input ports of the stage that this pass reads.
    pub fn reads(&self) -> impl Iterator<Item = &'static crate::port::Port> {
        let ignores = self.ignores;
        self.stage.inputs().filter(move |port| !ignores.contains(&port.name))
    }
    /// Position of counter `name`; panics if there is none (our bug).
    pub fn counter_index(&self, name: &str) -> usize {
        match self.counters.iter().position(|counter| counter.name == name) {
            Some(index) => index,
            None => unreachable!("pass {} has no counter {name}", self.name),
        }
    }
}

impl std::fmt::Debug for Pass {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.stage.name, self.name)
    }
}

/// All known stages and passes: ours, and those a host registers.
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    passes: Vec<&'static Pass>,
}

impl Catalogue {
    /// A catalogue of `passes`.
    pub fn new(passes: impl IntoIterator<Item = &'static Pass>) -> Self {
        let mut catalogue = Self::default();
        for pass in passes {
            catalogue.register(pass);
        }
        catalogue
    }
    /// Adds a pass; panics when its stage already has one of that name (a programming mistake of the caller).
    pub fn register(&mut self, pass: &'static Pass) {
        let known = self.pass(pass.stage.name, pass.name);
        assert!(known.is_none(), "{pass:?} is registered twice");
        self.passes.push(pass);
    }
    /// All passes in order of registration.
    pub fn passes(&self) -> impl Iterator<Item = &'static Pass> + '_ {
        self.passes.iter().copied()
    }
    /// Stages in order of first mention.
    pub fn stages(&self) -> Vec<&'static Stage> {
        let mut stages: Vec<&'static Stage> = Vec::new();
        for pass in &self.passes {
            if !stages.iter().any(|stage| stage.name == pass.stage.name) {
                stages.push(pass.stage);
            }
        }
        stages
    }
    /// The stage called `name`.
    pub fn stage(&self, name: &str) -> Option<&'static Stage> {
        self.passes.iter().map(|pass| pass.stage).find(|stage| stage.name == name)
    }
    /// The pass `name` of stage `stage`.
    pub fn pass(&self, stage: &str, name: &str) -> Option<&'static Pass> {
        self.passes.iter().copied().find(|pass| pass.stage.name == stage && pass.name == name)
    }
}
