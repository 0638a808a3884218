//! Which graph, and what it is drawn as.

use super::BackendChoice;
use clap::Args;

/// What to run and how it differs from the file.
#[derive(Clone, Debug, Default, Args)]
pub struct GraphChoice {
    /// A graph file, or a built-in name (see `shadowgraph graph --list`)
    #[arg(default_value = "hard")]
    pub graph: String,
    /// Use another pass for a node
    #[arg(long, value_name = "NODE=PASS")]
    pub swap: Vec<String>,
    /// Set a parameter of a node
    #[arg(long, value_name = "NODE.PARAM=VALUE")]
    pub set: Vec<String>,
    /// Pin a node to a backend
    #[arg(long, value_name = "NODE=cpu|wgpu")]
    pub on: Vec<String>,
    /// Give every transient memory of its own
    #[arg(long)]
    pub no_alias: bool,
}

/// `graph`.
#[derive(Clone, Debug, Args)]
pub struct GraphArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    /// Names of the built-in graphs with a line each
    #[arg(long)]
    pub list: bool,
    /// The graph file's own text
    #[arg(long, group = "form")]
    pub source: bool,
    /// Graphviz
    #[arg(long, group = "form")]
    pub dot: bool,
    /// Mermaid
    #[arg(long, group = "form")]
    pub mermaid: bool,
    /// SVG
    #[arg(long, group = "form")]
    pub svg: bool,
    /// Backend of nodes that are not pinned
    #[arg(long, value_enum, default_value = "cpu")]
    pub backend: BackendChoice,
    /// Hold this fact true while `choose` is resolved
    #[arg(long, value_name = "FACT")]
    pub fact: Vec<String>,
}
