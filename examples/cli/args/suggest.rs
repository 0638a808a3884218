//! `suggest`.

use super::{BackendChoice, SceneChoice};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  shadowgraph suggest --scene scene.glb --views views.json --error 0.02
  shadowgraph suggest --scene builtin:columns --light-radius 0.4 --ms 50 --metric flip_tonemapped
  shadowgraph suggest --chart chart --on columns --error 0.01      # from a chart that is there already

Without --chart the scene is measured: facts of scene and light decide what is tried. Exit status 1: nothing meets the bound.";

/// `suggest`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct SuggestArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    /// Largest error: of what meets it, the cheapest is suggested
    #[arg(long, value_name = "ERROR", value_parser = bound, conflicts_with = "ms", required_unless_present = "ms")]
    pub error: Option<f64>,
    /// Most milliseconds a frame: of what meets it, the most right is suggested
    #[arg(long, value_name = "MILLIS", value_parser = bound)]
    pub ms: Option<f64>,
    /// Which error; without it rmse_penumbra for a light with extent, else wrong_bit_share
    #[arg(long, value_name = "NAME")]
    pub metric: Option<String>,
    /// Suite whose methods are tried: a file or a built-in name; its scenes do not count. Without it the chart's, or `suggest`
    #[arg(long, value_name = "SUITE")]
    pub suite: Option<String>,
    /// Take the figures from the folder of a chart run instead of measuring
    #[arg(long, value_name = "DIR")]
    pub chart: Option<PathBuf>,
    /// The scene of that chart, where it has several
    #[arg(long, value_name = "NAME", requires = "chart")]
    pub on: Option<String>,
    /// Keep what is measured in this folder, where a run that was killed goes on; without it nothing is kept
    #[arg(long, value_name = "DIR", conflicts_with = "chart")]
    pub out: Option<PathBuf>,
    /// Where nodes run that are not pinned
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// As JSON on stdout
    #[arg(long)]
    pub json: bool,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}

/// A number that can be met.
fn bound(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| "expected a number, 0 or more".into())
}
