//! `shadowgraph export`: a scene as a glTF binary file.

use crate::args::ExportArgs;
use crate::file_problem;
use shadowgraph_core::problem::Problem;

/// Writes the file and says so.
///
/// # Errors
/// The scene cannot be loaded, the file cannot be written.
pub fn text(args: &ExportArgs) -> Result<String, Problem> {
    let scene = shadowgraph_scenes::load(&args.scene)?;
    let bytes = shadowgraph_scenes::export::write_glb(&scene);
    std::fs::write(&args.file, &bytes).map_err(|error| file_problem(&args.file, &error))?;
    Ok(format!("wrote {} triangles to {}\n", scene.triangle_count(), args.file.display()))
}
