//! What several test modules start from: scenes, jobs and graphs by their command-line names.

use clap::Parser;
use shadowgraph::args::{ChartArgs, Cli, Command, CompareArgs, MergeArgs, RenderArgs, SuggestArgs, VerifyArgs};
use shadowgraph::job::Job;

/// `render` as its command line would be understood.
pub fn render_args(words: &[&str]) -> RenderArgs {
    match Cli::parse_from(["shadowgraph", "render"].iter().chain(words)).command {
        Command::Render(args) => args,
        other => unreachable!("{other:?}"),
    }
}

/// `verify` likewise.
pub fn verify_args(words: &[&str]) -> VerifyArgs {
    match Cli::parse_from(["shadowgraph", "verify"].iter().chain(words)).command {
        Command::Verify(args) => args,
        other => unreachable!("{other:?}"),
    }
}

/// `compare` likewise, without progress bars.
pub fn compare_args(words: &[&str]) -> CompareArgs {
    match Cli::parse_from(["shadowgraph", "compare", "-q"].iter().chain(words)).command {
        Command::Compare(args) => args,
        other => unreachable!("{other:?}"),
    }
}

/// `chart` likewise.
pub fn chart_args(words: &[&str]) -> ChartArgs {
    match Cli::parse_from(["shadowgraph", "chart", "-q", "--backend", "cpu"].iter().chain(words)).command {
        Command::Chart(args) => args,
        other => unreachable!("{other:?}"),
    }
}

/// `merge` likewise.
pub fn merge_args(words: &[&str]) -> MergeArgs {
    match Cli::parse_from(["shadowgraph", "merge"].iter().chain(words)).command {
        Command::Merge(args) => args,
        other => unreachable!("{other:?}"),
    }
}

/// `suggest` likewise.
pub fn suggest_args(words: &[&str]) -> SuggestArgs {
    match Cli::parse_from(["shadowgraph", "suggest", "-q", "--backend", "cpu"].iter().chain(words)).command {
        Command::Suggest(args) => args,
        other => unreachable!("{other:?}"),
    }
}

/// A graph of these tests, by its name in `graphs/`.
pub fn graph_file(name: &str) -> String {
    format!("{}/graphs/{name}.ron", env!("CARGO_MANIFEST_DIR"))
}

/// A scene at a picture size, with one light sample.
pub fn job(scene: &str, size: &str) -> Job {
    job_lit(scene, size, &[])
}

/// The same with words for the light.
pub fn job_lit(scene: &str, size: &str, light: &[&str]) -> Job {
    let args = render_args(&[&["hard", "--scene", scene, "--size", size], light].concat());
    Job::load(&args.scene).unwrap_or_else(|problem| panic!("{scene}: {problem}"))
}

/// The same on so many light samples.
pub fn soft_job(scene: &str, size: &str, light_samples: &str) -> Job {
    job_lit(scene, size, &["--light-samples", light_samples])
}
