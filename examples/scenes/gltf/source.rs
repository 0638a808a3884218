//! The file being read, as problems name it.

use shadowgraph_core::problem::{Kind, Place, Problem};
use std::path::PathBuf;

/// A scene file.
pub struct Source {
    /// Name as the user gave it.
    pub name: String,
    /// Folder in which buffers of their own lie; none for a file in memory.
    pub folder: Option<PathBuf>,
}

impl Source {
    /// A problem at a path inside the file.
    pub fn problem(&self, kind: Kind, path: impl Into<String>, message: impl Into<String>) -> Problem {
        Problem::new(kind, message).at(Place { file: self.name.clone(), line: 0, column: 0, path: path.into() })
    }

    /// Element `index` of the root's array `array_name`, which the value at `path` names.
    pub fn item<'a, T>(&self, path: &str, array: &'a [T], array_name: &str, index: usize) -> Result<&'a T, Problem> {
        array.get(index).ok_or_else(|| {
            self.problem(Kind::BadValue, path, format!("{array_name}[{index}] does not exist"))
                .expected(format!("an index below {}", array.len()))
                .found(index.to_string())
        })
    }
}
