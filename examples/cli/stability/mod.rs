//! `stability`: methods along sequences over failure scenes, judged against the exact truth on the same view-samples.

pub mod edge;
pub mod frame;
pub mod judge;
pub mod place;
pub mod records;
pub mod run;
pub mod suite;
pub mod text;
