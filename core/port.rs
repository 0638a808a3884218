//! Ports: what a stage takes and gives, as data that can be checked before anything runs.

use crate::array::Element;

/// Which way the value goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Must be connected.
    In,
    /// May stay unconnected.
    OptionalIn,
    /// Produced by the pass.
    Out,
}

/// The coordinate space of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Space {
    /// Not a point or direction.
    None,
    /// The scene's own units, y up, right-handed.
    World,
    /// The light's image: texel columns, rows, and depth along the face's axis.
    Light,
    /// The camera's image: pixel columns and rows from the top left.
    Image,
}

/// What kind of memory a GPU holds the value in. On a CPU everything is an [`crate::array::Array`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Storage {
    /// A storage buffer of 32-bit words.
    Buffer,
    /// A depth texture, 32-bit float, 2D array; shape `[layers, height, width]`.
    DepthTexture,
    /// A 2D texture of four floats a texel; shape `[height, width, 4]`.
    Rgba32Float,
    /// A 2D texture of one unsigned integer a texel; shape `[height, width]`.
    R32Uint,
}

/// One port of a stage. Two ports fit when element, quantity, space and shape symbols are equal.
///
/// `shape` is written in symbols, outermost first, separated by blanks: `P` view-samples, `T` triangles, `L` light samples,
/// `F` faces of the light frame, `S` light texels a side, `C` cells (= F S S), `E` table entries, `H` `W` pixels, numbers.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Port {
    /// Name, the same in Rust, RON, dumps and charts.
    pub name: &'static str,
    /// Way.
    pub direction: Direction,
    /// Word type.
    pub element: Element,
    /// What is counted or measured: `position`, `length`, `offset`, `mask`, ... Part of the type: offsets do not fit lengths.
    pub quantity: &'static str,
    /// Symbols, outermost first.
    pub shape: &'static str,
    /// Unit, or empty.
    pub unit: &'static str,
    /// Space.
    pub space: Space,
    /// GPU memory.
    pub storage: Storage,
    /// One line: what it is, what zero or all bits set mean.
    pub doc: &'static str,
}

impl Port {
    /// A buffer port; refine with the functions below.
    pub const fn new(
        direction: Direction,
        name: &'static str,
        element: Element,
        quantity: &'static str,
        shape: &'static str,
    ) -> Self {
        Self {
            name,
            direction,
            element,
            quantity,
            shape,
            unit: "",
            space: Space::None,
            storage: Storage::Buffer,
            doc: "",
        }
    }
    /// The same port seen from the reading side.
    pub const fn read(mut self) -> Self {
        self.direction = Direction::In;
        self
    }
    /// The same port seen from a reading side that can do without it.
    pub const fn optional(mut self) -> Self {
        self.direction = Direction::OptionalIn;
        self
    }
    /// The same port seen from the producing side.
    pub const fn write(mut self) -> Self {
        self.direction = Direction::Out;
        self
    }
    /// The same type under another name (a scan's `length` takes any `list_length`).
    pub const fn named(mut self, name: &'static str) -> Self {
        self.name = name;
        self
    }
    /// Sets the unit.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }
    /// Sets the space.
    pub const fn space(mut self, space: Space) -> Self {
        self.space = space;
        self
    }
    /// Sets the GPU memory.
    pub const fn storage(mut self, storage: Storage) -> Self {
        self.storage = storage;
        self
    }
    /// Sets the doc line.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }
    /// Whether a value of `self` may be fed to `reader`.
    pub fn fits(&self, reader: &Port) -> bool {
        self.element == reader.element
            && self.quantity == reader.quantity
            && self.space == reader.space
            && self.shape == reader.shape
            && self.storage == reader.storage
    }
    /// `f32 position [P 3] world`, as errors and listings show it.
    pub fn type_text(&self) -> String {
        let element = match self.element {
            Element::U32 => "u32",
            Element::F32 => "f32",
        };
        let space = match self.space {
            Space::None => "",
            Space::World => " world",
            Space::Light => " light",
            Space::Image => " image",
        };
        let storage = match self.storage {
            Storage::Buffer => "",
            Storage::DepthTexture => " depth texture",
            Storage::Rgba32Float => " rgba32float texture",
            Storage::R32Uint => " r32uint texture",
        };
        format!("{element} {} [{}]{space}{storage}", self.quantity, self.shape)
    }
    /// Whether the port is read.
    pub fn is_input(&self) -> bool {
        self.direction != Direction::Out
    }
}
