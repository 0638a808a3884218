//! The tree.

use crate::source::Span;

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tree {
    pub span: Span,
    pub data: Data,
}

/// A value. Maps and structs keep every entry, equal keys too.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Data {
    Number(Number),
    Bool(bool),
    Text(String),
    /// A bare word, such as `Cpu`.
    Word(String),
    List(Vec<Tree>),
    Map(Vec<(Tree, Tree)>),
    /// `(name: value, ..)`.
    Struct(Vec<Field>),
    /// `(value, ..)`.
    Tuple(Vec<Tree>),
}

/// One named value of a struct.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Field {
    pub name: String,
    pub span: Span,
    pub value: Tree,
}

/// A number as written and as understood.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    pub text: String,
    /// Its value if it is whole and written without point or exponent.
    pub whole: Option<i128>,
    pub real: f64,
}

impl Data {
    /// What it is, for errors: `a list`, `"fused"`, `256`.
    pub fn text(&self) -> String {
        match self {
            Data::Number(number) => number.text.clone(),
            Data::Bool(value) => value.to_string(),
            Data::Text(text) => format!("{text:?}"),
            Data::Word(word) => word.clone(),
            Data::List(_) => "a list [..]".into(),
            Data::Map(_) => "a map {..}".into(),
            Data::Struct(_) => "a struct (name: ..)".into(),
            Data::Tuple(_) => "a tuple (..)".into(),
        }
    }
}
