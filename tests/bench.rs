//! What several test modules start from: scenes, jobs and graphs by their command-line names.

use clap::Parser;
use shadowgraph::args::{Cli, Command, RenderArgs, VerifyArgs};
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
