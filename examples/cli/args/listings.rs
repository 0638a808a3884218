//! What lists or writes without running a graph: `passes`, `scenes`, `export`.

use clap::Args;
use std::path::PathBuf;

/// `passes`.
#[derive(Clone, Debug, Args)]
pub struct PassesArgs {
    /// A stage, a pass, or STAGE/PASS
    pub name: Option<String>,
    /// As JSON
    #[arg(long, group = "form")]
    pub json: bool,
    /// As the Markdown of docs/PASSES.md
    #[arg(long, group = "form")]
    pub markdown: bool,
}

/// `scenes`.
#[derive(Clone, Debug, Args)]
pub struct ScenesArgs {
    /// Load this scene and print its facts
    pub scene: Option<String>,
    /// As JSON
    #[arg(long)]
    pub json: bool,
}

/// `export`.
#[derive(Clone, Debug, Args)]
pub struct ExportArgs {
    /// builtin:NAME?param=value, or a glTF file to be flattened
    pub scene: String,
    /// The .glb file to write
    pub file: PathBuf,
}
