//! `stability`.

use super::BackendChoice;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  shadowgraph stability --out stability_out                     # the suite that comes with the program
  shadowgraph stability my_suite.ron --scene contact --method shadow_map
  shadowgraph stability --shard 2/4 --out shared_folder         # another run without --shard reads what all shards wrote

A run that was killed goes on where it was. Exit status 1: a method that must hold does not.";

/// `stability`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct StabilityArgs {
    /// A suite file, or the built-in suite
    #[arg(default_value = "stability")]
    pub suite: String,
    /// Folder of records.jsonl, pictures/, stability.html and table.md
    #[arg(long, default_value = "stability_out", value_name = "DIR")]
    pub out: PathBuf,
    /// Only this scene of the suite; may be given several times
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// Only this method of the suite; may be given several times
    #[arg(long, value_name = "NAME")]
    pub method: Vec<String>,
    /// Do one of N parts of the cases, from 1
    #[arg(long, default_value = "1/1", value_name = "I/N")]
    pub shard: String,
    /// Where nodes of methods run that are not pinned; view-samples and truths are always made on the CPU
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// No progress
    #[arg(long, short)]
    pub quiet: bool,
}
