//! `check`.

use super::{BackendChoice, SceneChoice};
use clap::Args;

const EXAMPLES: &str = "Examples:
  shadowgraph check my_graph.ron other.ron
  shadowgraph check --invariance hard --scene builtin:columns --size 256x256
  shadowgraph check --invariance soft my_soft.ron --light-samples 64 --backend wgpu

With --invariance the graphs are run, in shuffled order, on poisoned and on shared memory, frame after frame, with other numbers of
threads and parts. Every port must have the same bits (lists: the same sets), else node and port are named and the exit status is 1.";

/// Names of the flags that need no scene.
const WITHOUT_SCENE: &[&str] = &["graphs", "json", "invariance"];

/// `check`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES, mut_args(needing_invariance))]
pub struct CheckArgs {
    /// Graph files or built-in names
    #[arg(required = true)]
    pub graphs: Vec<String>,
    /// Print the problems, or with --invariance what was found, as JSON
    #[arg(long)]
    pub json: bool,
    /// Run them, and require the same values whatever must not matter
    #[arg(long)]
    pub invariance: bool,
    /// Use another pass for a node
    #[arg(long, value_name = "NODE=PASS")]
    pub swap: Vec<String>,
    /// Set a parameter of a node
    #[arg(long, value_name = "NODE.PARAM=VALUE")]
    pub set: Vec<String>,
    /// Pin a node to a backend
    #[arg(long, value_name = "NODE=cpu|wgpu")]
    pub on: Vec<String>,
    /// Where nodes run that are not pinned
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// Shuffled orders to try
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub orders: u32,
    /// Frames of which the last is compared with the first
    #[arg(long, default_value_t = 10, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub frames: u32,
    /// Parts of the view-samples that are compared with the whole
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1000))]
    pub ranges: u32,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}

/// Flags that say how to run are refused where nothing runs.
fn needing_invariance(arg: clap::Arg) -> clap::Arg {
    if WITHOUT_SCENE.contains(&arg.get_id().as_str()) { arg } else { arg.requires("invariance") }
}
