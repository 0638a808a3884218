//! Code and WGSL pieces that several passes are made of.

pub mod atomic_words;
pub mod bvh;
pub mod camera;
pub mod contact;
pub mod expand;
pub mod footprint;
pub mod hard;
#[cfg(test)]
pub mod hard_scenes;
pub mod light_fit;
pub mod light_frame;
pub mod packed;
pub mod predicate;
pub mod prefetch;
pub mod pyramid;
pub mod receiver_tree;
pub mod receivers;
pub mod scan;
pub mod segments;
pub mod shading;
pub mod shadow_lookup;
pub mod shadow_map;
pub mod shadow_raster;
pub mod share;
pub mod table_fill;
pub mod threaded;
