//! `render`.

use super::{GraphChoice, RunChoice, SceneChoice};
use clap::Args;
use std::path::PathBuf;

/// `render`.
#[derive(Clone, Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub run: RunChoice,
    /// Mean over so many disjoint sets of light samples, one run each: 16 sets of 4096 make a converged reference
    #[arg(
        long,
        help_heading = "Light",
        value_name = "N",
        conflicts_with = "repeat",
        value_parser = clap::value_parser!(u32).range(2..=4096)
    )]
    pub light_sets: Option<u32>,
    /// Mean over so many frames, each with light samples of its own (seeds from --light-seed on), as a host shows it while nothing moves
    #[arg(
        long,
        help_heading = "Light",
        value_name = "N",
        conflicts_with_all = ["repeat", "light_sets"],
        value_parser = clap::value_parser!(u32).range(1..=10_000)
    )]
    pub frames: Option<u32>,
    /// Write the picture as DIR/image.png and DIR/image.exr
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write the graph's inputs and every live output port as .npy with DIR/index.json
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,
}
