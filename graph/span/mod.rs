//! RON text to a tree that knows where everything stands.
//!
//! The serde way through `ron` loses places and keeps the last of two equal map keys. This tree keeps every entry in the
//! order of the text with its place, so that all mistakes of a file can be told in one go. What it takes is checked to be
//! RON by `ron` itself.

mod lex;
mod parse;
mod reader;
mod value;

#[cfg(test)]
mod tests;

pub(crate) use parse::{parse, parse_fragment};
pub use reader::{Reader, read_ron};
pub use value::{Data, Field, Name, Number, Tree};
