//! `verify`.

use super::{GraphChoice, RunChoice, SceneChoice};
use clap::Args;
use std::path::PathBuf;

/// `verify`.
#[derive(Clone, Debug, Args)]
pub struct VerifyArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub run: RunChoice,
    /// The graph that is right
    #[arg(long, default_value = "truth_hard", value_name = "GRAPH")]
    pub truth: String,
    /// Every view of the views file for this scene, one after another
    #[arg(long)]
    pub all_views: bool,
    /// Largest accepted share of wrong bits outside the contact band; above it the exit status is 1
    #[arg(long, default_value_t = 0.0, value_name = "SHARE")]
    pub accept: f64,
    /// Half width of the contact band, in units of the last place of the coordinates involved
    #[arg(long, default_value_t = 4.0, value_name = "ULPS")]
    pub contact_ulps: f32,
    /// Write a picture of where the wrong bits are as DIR/wrong.png
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
