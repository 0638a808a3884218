//! How to run, as every command that runs takes it.

use clap::{Args, ValueEnum};

/// Which backend runs nodes that are not pinned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendChoice {
    /// A hardware adapter if there is one, else the CPU
    Auto,
    /// CPU functions
    Cpu,
    /// GPU recipes, on any adapter, software ones included
    Wgpu,
}

/// On what to run.
#[derive(Clone, Debug, Args)]
pub struct MachineChoice {
    /// Where nodes run that are not pinned
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Ranges of view-samples that run one after another, to bound memory; 0: as few as the device's bindings allow
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub ranges: u32,
    /// Print JSON on stdout instead of tables
    #[arg(long)]
    pub json: bool,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}

/// How to run.
#[derive(Clone, Debug, Args)]
pub struct RunChoice {
    /// Where nodes run that are not pinned
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Run so many times after one warm-up and report medians
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
    /// Ranges of view-samples that run one after another, to bound memory; 0: as few as the device's bindings allow
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub ranges: u32,
    /// Print the run's record as JSON on stdout instead of tables
    #[arg(long)]
    pub json: bool,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}
