//! Code and WGSL pieces that several passes are made of.

pub mod camera;
pub mod light_fit;
pub mod light_frame;
pub mod predicate;
pub mod scan;
