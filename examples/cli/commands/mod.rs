//! One file a subcommand. Each returns what to print and the exit status; only `main` prints.

pub mod chart;
pub mod check;
pub mod compare;
pub mod export;
pub mod graph;
pub mod passes;
pub mod profile;
pub mod render;
pub mod scenes;
pub mod stability;
pub mod suggest;
pub mod verify;
