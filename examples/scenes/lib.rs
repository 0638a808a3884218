//! Scenes as plain data: glTF 2.0 files, views files, procedural scenes.
//!
//! [`place::load`] makes a [`shadowgraph_core::scene::Scene`] of a path or of `builtin:NAME?param=value&..`;
//! [`place::choose_view`] finds a camera and a light for it. All that can be wrong with what a user gave is a
//! [`shadowgraph_core::problem::Problem`].
#![forbid(unsafe_code)]

pub mod builtin;
pub mod closed_form;
pub mod export;
pub mod gltf;
pub mod lights;
mod nearest;
pub mod place;
mod random;
pub mod soup;
pub mod topology;
pub mod vary;
pub mod views;

pub use place::{View, choose_from, choose_view, load, load_soup, view_names};
pub use topology::{open_all_parts, open_parts_around};
pub use vary::Variation;
pub use views::Views;

#[cfg(test)]
mod tests;
