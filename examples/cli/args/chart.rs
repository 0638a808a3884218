//! `chart` and `merge`.

use super::BackendChoice;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  shadowgraph chart chart_small --out chart                # runs anywhere: built-in scenes
  shadowgraph chart chart --scenes scenes --out chart      # every graph on Sponza and five other scenes
  shadowgraph chart my_suite.ron --out part1 --shard 1/4   # a quarter of it, for a job scheduler
  shadowgraph merge --out chart part1 part2 part3 part4

A run that was killed goes on where it was: start it again with the same --out.";

/// `chart`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ChartArgs {
    /// A suite file, or a built-in name: chart, chart_small
    pub suite: String,
    /// Folder for records, pictures and the page chart.html
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Folder in which the suite's scene and views files lie
    #[arg(long, value_name = "DIR")]
    pub scenes: Option<PathBuf>,
    /// Only this scene of the suite; may be repeated
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// Only part I of N: of the scenes, or of each scene's variants where there are fewer scenes than parts
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: String,
    /// Where nodes run that are not pinned, if the suite does not say
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Measure nothing: write the page anew from what is there
    #[arg(long)]
    pub page_only: bool,
    /// What was measured as JSON on stdout instead of a table
    #[arg(long)]
    pub json: bool,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}

/// `merge`.
#[derive(Clone, Debug, Args)]
pub struct MergeArgs {
    /// Folders of the parts
    #[arg(required = true)]
    pub parts: Vec<PathBuf>,
    /// Folder for the whole; may hold a part already
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}
