//! Charts as stand-alone SVG files. Colours stand in attributes, for any reader; classes let a page restyle them when it is dark.

pub mod axis;
pub mod bars;
mod canvas;
pub mod heat;
mod labels;
pub mod legend;
pub mod scatter;
pub mod sequence;

/// A picture, and what became of each record that was to be in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chart {
    /// A whole SVG document.
    pub svg: String,
    /// Ids of records drawn, each once.
    pub shown: Vec<String>,
    /// `(id, why it is not drawn)`.
    pub not_shown: Vec<(String, String)>,
}
