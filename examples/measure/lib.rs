//! Judging measurements: what a speed or an error is worth before anyone believes it.
//!
//! | Question | Module |
//! |---|---|
//! | How sure is this median? | [`statistics`] |
//! | Is B slower than A, by how much, and is that certain? | [`paired`] |
//! | How far do two pictures look apart? | [`flip`] |
//! | Which variants are not worth their time? | [`pareto`] |
//!
//! Nothing here runs a graph, reads a clock or prints: measurements come in as numbers, judgements go out as values. Metrics of
//! masks and visible fractions are in [`shadowgraph_core::metric`]. Numbers that are not finite are refused as a
//! [`shadowgraph_core::problem::Problem`], never left out.
#![forbid(unsafe_code)]

pub mod flip;
pub mod paired;
pub mod pareto;
pub mod statistics;
