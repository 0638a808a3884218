//! Command words for GPU recipes: what a pass wants a device to do, without any GPU API.
//!
//! A recipe is recorded once per prepared plan from shapes and parameters alone; values are on the device and never read
//! back here. All resources sit in group 0; the binding index is the position in [`Dispatch::bind`] or [`Draw::bind`].

use crate::param::Params;
use crate::pass::Pass;
use crate::port::Storage;
use crate::problem::Problem;
use std::ops::Range;

/// Makes the recipe of a node.
pub type GpuFn = fn(&mut GpuCx) -> Result<(), Problem>;

/// A piece of memory a command names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// An input or output port of the node.
    Port(&'static str),
    /// Scratch memory of the node, contents undefined at first.
    Scratch(usize),
    /// The node's counters, one u32 each in the order of [`Pass::counters`], zero at first.
    Counters,
}

/// Scratch memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Scratch {
    /// Label in captures and errors.
    pub label: &'static str,
    /// Buffer, or texture kind.
    pub storage: Storage,
    /// Words of a buffer: `[n]`; of a texture as the port's shape would be.
    pub shape: Vec<usize>,
}

/// Words between places that [`Bind::UniformOf`] may start at, and the number of which its length is a multiple of four.
pub const UNIFORM_WORDS: usize = 64;

/// What a shader sees at one binding.
#[derive(Clone, Debug, PartialEq)]
pub enum Bind {
    /// `var<uniform>`: these words, padded by the backend to 16 bytes.
    Uniform(Vec<u32>),
    /// `var<uniform>` over these words of scratch memory that earlier commands wrote, from a multiple of [`UNIFORM_WORDS`] on: devices
    /// read it faster than storage where neighbouring invocations read one place. At most 16 KiB, the least that devices bind.
    UniformOf(Target, Range<usize>),
    /// `var<storage, read>`.
    Read(Target),
    /// `var<storage, read_write>`.
    ReadWrite(Target),
    /// `texture_2d<f32>`, `texture_2d<u32>` or `texture_depth_2d_array`, by the storage of the target; used with `textureLoad`.
    Texture(Target),
}

/// WGSL pieces that are joined in order, and constants (`override`) given when the pipeline is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Shader {
    /// Pieces, each whole declarations.
    pub pieces: &'static [&'static str],
    /// Values of `override` constants by name.
    pub constants: Vec<(&'static str, f64)>,
}

/// How many workgroups.
#[derive(Clone, Debug, PartialEq)]
pub enum Groups {
    /// So many along x, y, z; each at most 65,535.
    Direct([u32; 3]),
    /// Three words at this word offset, written by an earlier command.
    Indirect(Target, usize),
}

/// One compute dispatch.
#[derive(Clone, Debug, PartialEq)]
pub struct Dispatch {
    /// Label in profiles and captures.
    pub label: &'static str,
    /// Source.
    pub shader: Shader,
    /// Entry point.
    pub entry: &'static str,
    /// Resources.
    pub bind: Vec<Bind>,
    /// Size.
    pub groups: Groups,
}

/// Which faces a draw drops, by winding in the target (counter-clockwise is front).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cull {
    /// Keep all.
    None,
    /// Drop clockwise triangles.
    Back,
    /// Drop counter-clockwise triangles.
    Front,
}

/// A depth attachment, 32-bit float.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTarget {
    /// A depth texture.
    pub target: Target,
    /// Layer of its array.
    pub layer: u32,
    /// Cleared to this first, or kept.
    pub clear: Option<f32>,
    /// Whether a fragment nearer than the stored one (compare less) replaces it; false leaves depth untouched and always passes.
    pub write: bool,
}

/// A colour attachment.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorTarget {
    /// A texture of storage [`Storage::Rgba32Float`] or [`Storage::R32Uint`].
    pub target: Target,
    /// Cleared to this first, or kept. For [`Storage::R32Uint`] the first number as an integer.
    pub clear: Option<[f64; 4]>,
}

/// One draw of triangles (vertex pulling: no vertex buffers) in a render pass of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Label in profiles and captures.
    pub label: &'static str,
    /// Source.
    pub shader: Shader,
    /// Vertex entry point.
    pub vertex: &'static str,
    /// Fragment entry point; none for depth only.
    pub fragment: Option<&'static str>,
    /// Resources, visible to both stages.
    pub bind: Vec<Bind>,
    /// Vertices an instance.
    pub vertices: u32,
    /// Instances.
    pub instances: u32,
    /// Size of the targets in pixels or texels. With neither colour nor depth the backend binds a dummy of this size.
    pub size: [u32; 2],
    /// Colour attachments.
    pub color: Vec<ColorTarget>,
    /// Depth attachment.
    pub depth: Option<DepthTarget>,
    /// Faces dropped.
    pub cull: Cull,
    /// Device conservative rasterisation; needs the feature.
    pub conservative: bool,
}

/// One command.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Fill a buffer with zero.
    Zero(Target),
    /// Run a kernel.
    Dispatch(Dispatch),
    /// Draw.
    Draw(Draw),
    /// Copy this many words from the start of one buffer to the start of another.
    Copy {
        /// Source.
        from: Target,
        /// Destination.
        to: Target,
        /// Number of words.
        words: usize,
    },
}

/// What a device allows, in the words of this crate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceLimits {
    /// Largest storage binding, bytes.
    pub storage_binding_bytes: u64,
    /// Largest 2D texture side.
    pub texture_side: u32,
    /// Storage buffers visible to one shader stage.
    pub storage_buffers: u32,
}

/// What a recipe is made from, and the recipe while it is being made.
pub struct GpuCx<'a> {
    pass: &'static Pass,
    params: &'a Params,
    image: [usize; 2],
    shapes: Vec<(&'static str, Vec<usize>)>,
    limits: DeviceLimits,
    scratch: Vec<Scratch>,
    commands: Vec<Command>,
}

impl<'a> GpuCx<'a> {
    /// For backends. `shapes` holds every connected input and every output port.
    pub fn new(
        pass: &'static Pass,
        params: &'a Params,
        image: [usize; 2],
        shapes: Vec<(&'static str, Vec<usize>)>,
        limits: DeviceLimits,
    ) -> Self {
        Self { pass, params, image, shapes, limits, scratch: Vec::new(), commands: Vec::new() }
    }
    /// Parameters of the node.
    pub fn params(&self) -> &'a Params {
        self.params
    }
    /// Picture width and height, pixels.
    pub fn image(&self) -> [usize; 2] {
        self.image
    }
    /// Device limits.
    pub fn limits(&self) -> DeviceLimits {
        self.limits
    }
    /// Whether optional input `port` is connected.
    pub fn is_connected(&self, port: &str) -> bool {
        self.shapes.iter().any(|(name, _)| *name == port)
    }
    /// Shape of a connected input or an output.
    pub fn shape(&self, port: &str) -> &[usize] {
        match self.shapes.iter().find(|(name, _)| *name == port) {
            Some((_, shape)) => shape,
            None => unreachable!("{:?} asks for the shape of {port}", self.pass),
        }
    }
    /// Length of dimension `axis` of a port.
    pub fn dim(&self, port: &str, axis: usize) -> usize {
        self.shape(port).get(axis).copied().unwrap_or(1)
    }
    /// Number of words of a port.
    pub fn words(&self, port: &str) -> usize {
        self.shape(port).iter().product()
    }
    /// A scratch buffer of `words` words, contents undefined.
    pub fn scratch(&mut self, label: &'static str, words: usize) -> Target {
        self.scratch_texture(label, Storage::Buffer, vec![words.max(1)])
    }
    /// Scratch memory of any kind.
    pub fn scratch_texture(&mut self, label: &'static str, storage: Storage, shape: Vec<usize>) -> Target {
        self.scratch.push(Scratch { label, storage, shape });
        Target::Scratch(self.scratch.len() - 1)
    }
    /// Appends a command.
    pub fn push(&mut self, command: Command) {
        self.commands.push(command);
    }
    /// Fills with zero.
    pub fn zero(&mut self, target: Target) {
        self.push(Command::Zero(target));
    }
    /// A dispatch of at least `invocations` invocations in groups of `group` along x, folded into y past 65,535 groups.
    /// The kernel computes its index as `id.x + id.y * 65535u * group` and must check it against its bound.
    pub fn dispatch(
        &mut self,
        label: &'static str,
        pieces: &'static [&'static str],
        entry: &'static str,
        bind: Vec<Bind>,
        invocations: usize,
        group: usize,
    ) {
        let groups = fold_groups(invocations.div_ceil(group));
        let shader = Shader { pieces, constants: Vec::new() };
        self.push(Command::Dispatch(Dispatch { label, shader, entry, bind, groups: Groups::Direct(groups) }));
    }
    /// For backends.
    pub fn finish(self) -> (Vec<Scratch>, Vec<Command>) {
        (self.scratch, self.commands)
    }
}

/// Groups along x and y for a one-dimensional dispatch: x is 65,535 once it does not fit.
pub fn fold_groups(count: usize) -> [u32; 3] {
    let count = count.max(1);
    if count <= 65_535 { [count as u32, 1, 1] } else { [65_535, count.div_ceil(65_535) as u32, 1] }
}
