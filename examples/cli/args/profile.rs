//! `profile`.

use super::{GraphChoice, MachineChoice, SceneChoice};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  shadowgraph profile hard --scene builtin:columns
  shadowgraph profile soft --light-samples 64 --backend wgpu --frames 100 --statistics
  shadowgraph profile hard --backend wgpu --trace trace.json     # open it at ui.perfetto.dev
  shadowgraph profile hard --backend wgpu --no-timers            # whole frames alone, undisturbed
  shadowgraph profile hard --json | jq '.nodes[] | {node, in_frame}'

Times are milliseconds. `in frame`: a node within whole frames; `alone`: the same node by itself, again and again, on the values it
had. On a GPU both come from timestamps at the borders of its passes, on software rasterisers from the host's clock around a
submission of its own, on the CPU from the host's clock around its function.";

/// `profile`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ProfileArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub machine: MachineChoice,
    /// Frames measured with timers on, and as many with timers off where timers cost something
    #[arg(long, default_value_t = 30, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Frames that run before, unmeasured, after the cold one
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub warm_up: u32,
    /// Runs of each node alone; 0 for none; without it as many as frames
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub alone: Option<u32>,
    /// Time no node: only whole frames, as a host would run them
    #[arg(long, conflicts_with_all = ["alone", "statistics"])]
    pub no_timers: bool,
    /// Also count how often shaders ran, where the device can (PIPELINE_STATISTICS_QUERY), in a frame of its own
    #[arg(long)]
    pub statistics: bool,
    /// Write a row for each node
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write all measured frames in the Chrome trace format, which Perfetto opens
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
}
