//! From measured records to pictures and pages: JSON Lines in, CSV, SVG and one self-contained HTML file out.
//!
//! Measures nothing, runs no graph, opens no file: whoever calls reads and writes, and hands over bytes and text.

pub mod check;
pub mod lines;
pub mod model;
