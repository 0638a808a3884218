//! A graph file as written: every word with its place. Nothing here knows which stages and passes exist.

use crate::source::Span;
pub(crate) use crate::span::Name;
use shadowgraph_core::param::Value;
use shadowgraph_core::plan::Backend;

/// The version of the format that this crate reads.
pub const VERSION: u32 = 1;

/// A parameter value of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scalar {
    /// None when it is no number, switch or word: told already.
    pub value: Option<Value>,
    /// As written.
    pub text: String,
    pub span: Span,
}

/// One file.
#[derive(Clone, Debug, Default)]
pub(crate) struct FileWritten {
    pub doc: Option<Name>,
    pub base: Option<Name>,
    pub inputs: Option<Vec<Name>>,
    pub nodes: Option<(Span, Vec<NodeWritten>)>,
    pub replace: Option<(Span, Vec<NodeWritten>)>,
    pub add: Option<(Span, Vec<NodeWritten>)>,
    pub remove: Option<(Span, Vec<Name>)>,
    pub outputs: Option<Vec<(Name, Name)>>,
    pub axes: Vec<(Name, Vec<Scalar>)>,
    pub light_samples: Option<u32>,
}

/// `when` and `unless`: holds where the one fact does and the other does not.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct GuardWritten {
    pub when: Option<Name>,
    pub unless: Option<Name>,
}

/// A node, or the differences of one.
#[derive(Clone, Debug)]
pub(crate) struct NodeWritten {
    pub id: Name,
    pub stage: Option<Name>,
    pub pass: Option<Name>,
    pub params: Vec<(Name, Scalar)>,
    pub on: Option<(Backend, Span)>,
    pub inputs: Vec<(Name, Name)>,
    pub choose: Option<Vec<AlternativeWritten>>,
    pub guard: GuardWritten,
}

/// A guarded alternative of a node.
#[derive(Clone, Debug)]
pub(crate) struct AlternativeWritten {
    pub span: Span,
    pub guard: GuardWritten,
    pub pass: Option<Name>,
    pub params: Vec<(Name, Scalar)>,
}

impl GuardWritten {
    pub fn is_empty(&self) -> bool {
        self.when.is_none() && self.unless.is_none()
    }
}

impl NodeWritten {
    /// The stage's name and where it stands: the id where none is given.
    pub fn stage(&self) -> &Name {
        self.stage.as_ref().unwrap_or(&self.id)
    }
}
