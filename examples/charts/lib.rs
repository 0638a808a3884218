//! From measured records to pictures and pages: JSON Lines in, CSV, SVG and one self-contained HTML file out.
//!
//! Measures nothing, runs no graph, opens no file: whoever calls reads and writes, and hands over bytes and text.

pub mod check;
pub mod csv;
pub mod error_map;
pub mod files;
pub mod front;
pub mod group;
pub mod lines;
pub mod markup;
pub mod metric;
pub mod model;
pub mod number;
pub mod page;
pub mod style;
pub mod svg;

#[cfg(test)]
extern crate self as shadowgraph_charts;
#[cfg(test)]
mod synthetic;
#[cfg(test)]
mod tests;
