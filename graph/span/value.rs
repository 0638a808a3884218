//! The tree.

use crate::source::Span;

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Where it stands.
    pub span: Span,
    /// What it is.
    pub data: Data,
}

/// A value. Maps and structs keep every entry, equal keys too.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// `256`, `1e-3`.
    Number(Number),
    /// `true` or `false`.
    Bool(bool),
    /// Text in quotes.
    Text(String),
    /// A bare word, such as `Cpu`.
    Word(String),
    /// `[value, ..]`.
    List(Vec<Tree>),
    /// `{key: value, ..}`.
    Map(Vec<(Tree, Tree)>),
    /// `(name: value, ..)`.
    Struct(Vec<Field>),
    /// `(value, ..)`.
    Tuple(Vec<Tree>),
}

/// One named value of a struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
    /// Its value.
    pub value: Tree,
}

/// A number as written and as understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// As written.
    pub text: String,
    /// Its value if it is whole and written without point or exponent.
    pub whole: Option<i128>,
    /// Its value.
    pub real: f64,
}

/// A word of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The word.
    pub text: String,
    /// Where it stands.
    pub span: Span,
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
