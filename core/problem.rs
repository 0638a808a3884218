//! What can be wrong with what a user gave us, as typed values. Text is made here once, for every surface.

use std::fmt;

/// The kind of a problem, for scripts and tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Kind {
    /// Text or bytes that do not parse.
    Syntax,
    /// A key, field or parameter that does not exist.
    UnknownName,
    /// The same name given twice.
    Duplicate,
    /// Something required is absent.
    Missing,
    /// A value outside its range or of another type.
    BadValue,
    /// Two ports that do not fit.
    PortMismatch,
    /// Nodes that feed each other in a circle.
    Cycle,
    /// A pass that does not run on the asked backend, or a device feature that is absent.
    Unsupported,
    /// A buffer that would have had to be larger.
    Overflow,
    /// Geometry that cannot be used.
    BadGeometry,
    /// A file that cannot be read or written.
    File,
    /// No device, lost device, out of memory.
    Device,
    /// A pass whose ports, recipe and kernel disagree: a mistake of whoever wrote the pass.
    BadPass,
}

/// Where in a file, 1-based.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Place {
    /// File name as the user gave it, or `builtin:NAME`.
    pub file: String,
    /// 1-based; 0 when the place is a whole file or a path inside a binary file.
    pub line: usize,
    /// 1-based; 0 likewise.
    pub column: usize,
    /// A path inside the file where lines do not exist, such as `nodes[3].mesh`; empty otherwise.
    pub path: String,
}

/// One thing that is wrong: where, what was expected, what was found, what to do.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Problem {
    /// Its kind.
    pub kind: Kind,
    /// One sentence without a full stop.
    pub message: String,
    /// Where it is, if in a file.
    pub place: Option<Place>,
    /// The node it concerns, if any.
    pub node: Option<String>,
    /// The port or parameter it concerns, if any.
    pub port: Option<String>,
    /// What would have been right.
    pub expected: Option<String>,
    /// What was there.
    pub found: Option<String>,
    /// The nearest valid name, or what to do instead.
    pub remedy: Option<String>,
}

impl Problem {
    /// A problem with a message only; add the rest with the `with_` functions.
    pub fn new(kind: Kind, message: impl Into<String>) -> Self {
        Self {
            kind,
            message: message.into(),
            place: None,
            node: None,
            port: None,
            expected: None,
            found: None,
            remedy: None,
        }
    }
    /// Where it is.
    pub fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }
    /// The node it concerns.
    pub fn node(mut self, node: impl Into<String>) -> Self {
        self.node = Some(node.into());
        self
    }
    /// The port or parameter it concerns.
    pub fn port(mut self, port: impl Into<String>) -> Self {
        self.port = Some(port.into());
        self
    }
    /// What would have been right.
    pub fn expected(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(expected.into());
        self
    }
    /// What was there.
    pub fn found(mut self, found: impl Into<String>) -> Self {
        self.found = Some(found.into());
        self
    }
    /// What to do.
    pub fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{}", place.file)?;
            if place.line > 0 {
                write!(f, ":{}:{}", place.line, place.column)?;
            }
            if !place.path.is_empty() {
                write!(f, ": {}", place.path)?;
            }
            write!(f, ": ")?;
        }
        match (&self.node, &self.port) {
            (Some(node), Some(port)) => write!(f, "{node}.{port}: ")?,
            (Some(node), None) => write!(f, "{node}: ")?,
            (None, Some(port)) => write!(f, "{port}: ")?,
            (None, None) => {}
        }
        write!(f, "{}", self.message)?;
        if let Some(expected) = &self.expected {
            write!(f, "; expected {expected}")?;
        }
        if let Some(found) = &self.found {
            write!(f, "; found {found}")?;
        }
        if let Some(remedy) = &self.remedy {
            write!(f, " ({remedy})")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}

/// Every problem found in one go, in the order of the text.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Problems(pub Vec<Problem>);

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self(vec![problem])
    }
}
