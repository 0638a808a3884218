//! One binary: every rule, case and comparison that spans crates. `cargo test -p shadowgraph-tests -- FILTER` runs a part.

mod area_lights;
mod baselines;
mod bench;
mod chart_place;
mod chart_points;
mod chart_runs;
mod closed_form;
mod compare;
mod contamination;
mod counters;
mod device_raster;
mod docs;
mod frames;
mod gpu;
mod graphs;
mod help;
mod pairs;
mod planted;
mod program;
mod ranges;
mod shading;
mod stability;
mod suggest;
mod suite;
mod suites;
mod tidy;
mod truth;
mod twins;

use libtest_mimic::{Arguments, Trial};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials: Vec<Trial> = Vec::new();
    trials.extend(tidy::trials());
    trials.extend(docs::trials());
    trials.extend(suite::trials());
    trials.extend(graphs::trials());
    trials.extend(twins::controls());
    trials.extend(twins::trials());
    trials.extend(pairs::trials());
    trials.extend(area_lights::trials());
    trials.extend(contamination::trials());
    trials.extend(counters::trials());
    trials.extend(ranges::trials());
    trials.extend(device_raster::trials());
    trials.extend(truth::trials());
    trials.extend(closed_form::trials());
    trials.extend(shading::trials());
    trials.extend(frames::trials());
    trials.extend(baselines::trials());
    trials.extend(compare::trials());
    trials.extend(suites::trials());
    trials.extend(chart_runs::trials());
    trials.extend(chart_points::trials());
    trials.extend(suggest::trials());
    trials.extend(help::trials());
    trials.extend(stability::trials());
    trials.extend(program::trials());
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// The workspace's top folder.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_path_buf).unwrap_or_default()
}
