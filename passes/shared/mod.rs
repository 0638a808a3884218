//! Code and WGSL pieces that several passes are made of.

#[cfg(any(test, feature = "random_scenes"))]
pub mod area_light_scenes;
pub mod atomic_words;
pub mod bvh;
pub mod camera;
pub mod contact;
pub mod expand;
pub mod face_light;
pub mod footprint;
pub mod hard;
#[cfg(any(test, feature = "random_scenes"))]
pub mod hard_scenes;
pub mod hull;
pub mod influence;
pub mod influence_gpu;
pub mod light_bound;
pub mod light_box;
pub mod light_box_gpu;
pub mod light_fit;
pub mod light_frame;
pub mod light_sides;
pub mod lu;
pub mod lu_fill;
pub mod lu_look_up;
pub mod lu_record;
pub mod neighbours;
pub mod packed;
pub mod pair_counts;
pub mod pair_walk;
pub mod pair_walk_gpu;
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
pub mod soft;
pub mod soft_record;
#[cfg(any(test, feature = "random_scenes"))]
pub mod soft_scenes;
pub mod table_fill;
pub mod threaded;
pub mod view_planes;
