//! From what stands on a command line to a scene and a view of it.

use crate::{builtin, gltf};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::Scene;
use std::path::Path;

/// Loads a path to a .glb or .gltf file, or `builtin:NAME?param=value&..`.
pub fn load(spec: &str) -> Result<Scene, Problem> {
    match spec.strip_prefix(builtin::PREFIX) {
        Some(rest) => builtin::build(rest),
        None => gltf::load(Path::new(spec)),
    }
}
