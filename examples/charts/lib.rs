//! From measured records to pictures and pages: JSON Lines in, CSV, SVG and one self-contained HTML file out.
//!
//! Measures nothing, runs no graph, opens no file: whoever calls reads and writes, and hands over bytes and text.
//!
//! | Step | Where |
//! |---|---|
//! | a record as a line of a file, and all lines of a file, also of one that a killed run left | [`lines`] |
//! | who is on the front, unless the caller has a finder of its own | [`front`] |
//! | one chart as stand-alone SVG | [`svg`]; all of a suite: [`files`] |
//! | the page of a suite, the page of stability | [`page::charts`], [`page::stability`] |
//! | tables for other programs | [`csv`] |
//! | the colours that error maps have in pages | [`error_map`] |
//!
//! Invariants: every record is in each chart once, or listed with the reason why not; a number that is not finite is refused
//! with its place, never drawn; every text is escaped by [`markup`]; a page fetches nothing.

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
