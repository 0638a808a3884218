//! `check`.

use clap::Args;

/// `check`.
#[derive(Clone, Debug, Args)]
pub struct CheckArgs {
    /// Graph files or built-in names
    #[arg(required = true)]
    pub graphs: Vec<String>,
    /// Print the problems as JSON
    #[arg(long)]
    pub json: bool,
}
