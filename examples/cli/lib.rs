//! What a program that runs graphs needs beside the libraries: scene and view by name, a run across both backends, records,
//! dumps, pictures, verification.

pub mod answers;
pub mod args;
pub mod chart;
pub mod commands;
pub mod compare;
pub mod converged;
pub mod dump;
pub mod engine;
pub mod frames;
pub mod graph_choice;
pub mod invariance;
pub mod jitter;
pub mod job;
mod kept;
pub mod light_choice;
pub mod npy;
pub mod outcome;
pub mod picture;
pub mod port_difference;
pub mod profile;
pub mod ranges;
pub mod record;
pub mod report;
pub mod shard;
pub mod stability;
pub mod stretch;
pub mod suggest;
pub mod texture;
pub mod trial;
pub mod verify;

use shadowgraph_core::problem::{Kind, Place, Problem};
use std::path::Path;

/// A whole file as the place of a problem.
pub fn whole_file(path: &Path) -> Place {
    Place { file: path.display().to_string(), line: 0, column: 0, path: String::new() }
}

/// A file that cannot be read or written.
pub fn file_problem(path: &Path, error: &std::io::Error) -> Problem {
    Problem::new(Kind::File, error.to_string()).at(whole_file(path)).remedy("check the path and its rights")
}

/// What went wrong on the command line itself.
pub fn usage_problem(message: impl Into<String>) -> Problem {
    let place = Place { file: "command line".into(), line: 0, column: 0, path: String::new() };
    Problem::new(Kind::BadValue, message).at(place)
}
