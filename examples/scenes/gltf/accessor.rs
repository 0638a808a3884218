//! Accessors read element by element, never as a whole: a file that declares four thousand million elements costs nothing
//! until one is asked for, and none is allocated.

use super::limits;
use super::source::Source;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;
use gltf::json::{Root, accessor::sparse::Sparse};
use shadowgraph_core::problem::{Kind, Problem};
use std::borrow::Cow;
use std::cell::Cell;

/// What accessors are read from.
pub struct Reader<'a> {
    /// For problems.
    pub source: &'a Source,
    /// The typed tree.
    pub root: &'a Root,
    /// Bytes of each buffer.
    pub buffers: &'a [Cow<'a, [u8]>],
    /// Elements read so far, of [`limits::READS`].
    pub reads: Cell<u64>,
}

/// Elements of one accessor, all inside their buffer.
pub struct Elements<'a> {
    /// Number of elements.
    pub count: usize,
    /// The value in the file that names the accessor, for problems.
    pub path: String,
    base: Option<Strided<'a>>,
    replaced: Option<Replaced<'a>>,
    component: ComponentType,
    normalized: bool,
}

struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

/// Sparse entries: ascending element numbers, and the values they get.
struct Replaced<'a> {
    numbers: Vec<u32>,
    values: Strided<'a>,
}

impl<'a> Reader<'a> {
    /// Counts elements that will be read; refuses a file that asks for too many.
    pub fn spend(&self, path: &str, elements: u64) -> Result<(), Problem> {
        self.reads.set(self.reads.get().saturating_add(elements));
        if self.reads.get() <= limits::READS {
            return Ok(());
        }
        Err(self
            .source
            .problem(Kind::BadValue, path, "the file asks for too many vertex reads")
            .expected(format!("at most {}", limits::READS))
            .found(format!("{} up to here", self.reads.get()))
            .remedy("instance less, or bake morph targets and skins"))
    }

    /// Opens accessor `index`, which the value at `path` names, if its elements are of `kind` and one of `components`.
    pub fn open(
        &self,
        path: String,
        index: usize,
        kind: Type,
        components: &[ComponentType],
    ) -> Result<Elements<'a>, Problem> {
        let accessor = self.source.item(&path, &self.root.accessors, "accessors", index)?;
        let inner = format!("accessors[{index}]");
        let wrong = |field: &str, expected: String| {
            self.source
                .problem(Kind::BadValue, format!("{inner}.{field}"), format!("wrong elements for {path}"))
                .expected(expected)
        };
        match &accessor.type_ {
            Checked::Valid(found) if *found == kind => {}
            other => return Err(wrong("type", format!("{kind:?}")).found(format!("{other:?}"))),
        }
        let component = match &accessor.component_type {
            Checked::Valid(found) if components.contains(&found.0) => found.0,
            other => return Err(wrong("componentType", format!("one of {components:?}")).found(format!("{other:?}"))),
        };
        let size = component.size() * kind.multiplicity();
        let count = accessor.count.0;
        let base = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
                Some(self.strided(&inner, view.value(), offset, count, size)?)
            }
            None if accessor.sparse.is_some() => None,
            None => {
                return Err(self
                    .source
                    .problem(Kind::Missing, format!("{inner}.bufferView"), "the accessor has no contents")
                    .expected("a bufferView or sparse entries")
                    .remedy("if the mesh is compressed, export it without compression"));
            }
        };
        let replaced = match &accessor.sparse {
            Some(sparse) => Some(self.replaced(&format!("{inner}.sparse"), sparse, count, size)?),
            None => None,
        };
        // Vertex numbers are u32, so no element past that can be asked for.
        let count = count.min(u64::from(u32::MAX)) as usize;
        Ok(Elements { count, path, base, replaced, component, normalized: accessor.normalized })
    }

    fn replaced(&self, path: &str, sparse: &Sparse, count: u64, size: usize) -> Result<Replaced<'a>, Problem> {
        let entries = sparse.count.0;
        let Checked::Valid(component) = &sparse.indices.component_type else {
            return Err(self
                .source
                .problem(Kind::BadValue, format!("{path}.indices.componentType"), "not an index type")
                .expected("U8, U16 or U32"));
        };
        let component = component.0;
        let of = |name: &str| format!("{path}.{name}");
        let (indices, values) = (&sparse.indices, &sparse.values);
        let at = self.strided(
            &of("indices"),
            indices.buffer_view.value(),
            indices.byte_offset.0,
            entries,
            component.size(),
        )?;
        let values = self.strided(&of("values"), values.buffer_view.value(), values.byte_offset.0, entries, size)?;
        self.spend(path, entries)?;
        let mut numbers: Vec<u32> = Vec::with_capacity(entries as usize);
        for entry in 0..entries as usize {
            let number = unsigned(component, &at.bytes[entry * at.stride..]);
            let ascends = numbers.last().is_none_or(|last| *last < number);
            if u64::from(number) >= count || !ascends {
                return Err(self
                    .source
                    .problem(Kind::BadValue, format!("{path}.indices[{entry}]"), "wrong sparse index")
                    .expected(format!("ascending indices below {count}"))
                    .found(number.to_string()));
            }
            numbers.push(number);
        }
        Ok(Replaced { numbers, values })
    }

    /// `count` elements of `size` bytes each, from `offset` into a buffer view, if they all lie inside it.
    fn strided(&self, path: &str, view: usize, offset: u64, count: u64, size: usize) -> Result<Strided<'a>, Problem> {
        let source = self.source;
        let view_path = format!("{path}.bufferView");
        let found = source.item(&view_path, &self.root.buffer_views, "bufferViews", view)?;
        let inner = format!("bufferViews[{view}]");
        let buffer = found.buffer.value();
        let bytes: &'a [u8] = source.item(&format!("{inner}.buffer"), self.buffers, "buffers", buffer)?;
        let start = found.byte_offset.map_or(0, |offset| offset.0);
        let end = start.saturating_add(found.byte_length.0);
        if end > bytes.len() as u64 {
            return Err(source
                .problem(Kind::BadValue, inner, format!("the view ends behind buffers[{buffer}]"))
                .expected(format!("an end of at most {}", bytes.len()))
                .found(end.to_string()));
        }
        let stride = found.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            return Err(source
                .problem(Kind::BadValue, format!("{inner}.byteStride"), "elements overlap")
                .expected(format!("at least {size}"))
                .found(stride.to_string()));
        }
        let wanted = match count {
            0 => offset,
            _ => (count - 1).saturating_mul(stride as u64).saturating_add(size as u64).saturating_add(offset),
        };
        if wanted > found.byte_length.0 {
            return Err(source
                .problem(Kind::BadValue, path, format!("{count} elements end behind {inner}"))
                .expected(format!("at most {} bytes", found.byte_length.0))
                .found(format!("{wanted} bytes")));
        }
        Ok(Strided { bytes: &bytes[(start + offset) as usize..end as usize], stride })
    }
}

impl Elements<'_> {
    /// Bytes of element `index`, which is below `count`; none where only sparse entries have contents.
    fn bytes(&self, index: usize) -> Option<&[u8]> {
        if let Some(Replaced { numbers, values }) = &self.replaced
            && let Ok(entry) = numbers.binary_search(&(index as u32))
        {
            return Some(&values.bytes[entry * values.stride..]);
        }
        self.base.as_ref().map(|base| &base.bytes[index * base.stride..])
    }

    /// A whole number of one lane.
    pub fn unsigned(&self, index: usize) -> u32 {
        self.bytes(index).map_or(0, |bytes| unsigned(self.component, bytes))
    }

    /// `LANES` whole numbers.
    pub fn unsigned_lanes<const LANES: usize>(&self, index: usize) -> [u32; LANES] {
        let size = self.component.size();
        self.bytes(index)
            .map_or([0; LANES], |bytes| std::array::from_fn(|lane| unsigned(self.component, &bytes[lane * size..])))
    }

    /// `LANES` numbers, normalised where the accessor says so. May be NaN or infinite.
    pub fn numbers<const LANES: usize>(&self, index: usize) -> [f64; LANES] {
        let size = self.component.size();
        self.bytes(index).map_or([0.0; LANES], |bytes| {
            std::array::from_fn(|lane| number(self.component, self.normalized, &bytes[lane * size..]))
        })
    }
}

fn unsigned(component: ComponentType, bytes: &[u8]) -> u32 {
    match component {
        ComponentType::U8 | ComponentType::I8 => u32::from(bytes[0]),
        ComponentType::U16 | ComponentType::I16 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        ComponentType::U32 | ComponentType::F32 => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}

fn number(component: ComponentType, normalized: bool, bytes: &[u8]) -> f64 {
    let bits = unsigned(component, bytes);
    let (value, largest) = match component {
        ComponentType::F32 => return f64::from(f32::from_bits(bits)),
        ComponentType::U32 => return f64::from(bits),
        ComponentType::U8 => (f64::from(bits), 255.0),
        ComponentType::U16 => (f64::from(bits), 65535.0),
        ComponentType::I8 => (f64::from(bits as u8 as i8), 127.0),
        ComponentType::I16 => (f64::from(bits as u16 as i16), 32767.0),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}
