//! The shadowgraph program. Wiring only: it reads the command line, calls, prints.

use clap::Parser;
use shadowgraph::args::{Cli, Command};
use shadowgraph::commands::{
    chart, check, compare, export, graph, passes, profile, render, scenes, stability, suggest, verify,
};
use shadowgraph_core::problem::Problems;
use std::io::Write;
use std::process::ExitCode;
use tracing_subscriber::EnvFilter;

/// Exit status of a run that finished with a verdict the user did not accept.
const NOT_ACCEPTED: u8 = 1;
/// Exit status of a run that could not finish: the user's mistake or the world's.
const PROBLEM: u8 = 2;

fn main() -> ExitCode {
    let filter = EnvFilter::try_from_env("SHADOWGRAPH_LOG").unwrap_or_else(|_| EnvFilter::new("error"));
    tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr).init();
    let cli = Cli::parse();
    let (text, is_accepted) = match run(&cli.command) {
        Ok(done) => done,
        Err(problems) => {
            eprintln!("{problems}");
            return ExitCode::from(PROBLEM);
        }
    };
    // A reader that closes the pipe early is no failure.
    let _ = std::io::stdout().write_all(text.as_bytes());
    if is_accepted { ExitCode::SUCCESS } else { ExitCode::from(NOT_ACCEPTED) }
}

fn run(command: &Command) -> Result<(String, bool), Problems> {
    let catalogue = shadowgraph_passes::catalogue();
    let threads = match command {
        Command::Render(args) => args.run.threads,
        Command::Verify(args) => args.run.threads,
        Command::Stability(args) => args.threads,
        Command::Compare(args) => args.threads,
        Command::Chart(args) => args.threads,
        Command::Suggest(args) => args.threads,
        Command::Profile(args) => args.machine.threads,
        _ => 0,
    };
    // Only fails when a pool exists already, which none does here.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    Ok(match command {
        Command::Render(args) => (render::text(&catalogue, args)?, true),
        Command::Verify(args) => verify::text(&catalogue, args)?,
        Command::Compare(args) => compare::text(&catalogue, args)?,
        Command::Chart(args) => (chart::text(&catalogue, args)?, true),
        Command::Suggest(args) => suggest::text(&catalogue, args)?,
        Command::Merge(args) => (chart::merge_text(args)?, true),
        Command::Profile(args) => (profile::text(&catalogue, args)?, true),
        Command::Check(args) => check::text(&catalogue, args)?,
        Command::Stability(args) => stability::text(&catalogue, args)?,
        Command::Graph(args) => (graph::text(&catalogue, args)?, true),
        Command::Passes(args) => (passes::text(&catalogue, args)?, true),
        Command::Scenes(args) => (scenes::text(args)?, true),
        Command::Export(args) => (export::text(args)?, true),
    })
}
