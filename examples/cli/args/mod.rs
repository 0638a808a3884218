//! The command line, as clap sees it: one file a command, and one for what several take.

mod check;
mod compare;
mod graph;
mod listings;
mod render;
mod run;
mod scene;
mod stability;
mod verify;

pub use check::CheckArgs;
pub use compare::CompareArgs;
pub use graph::{GraphArgs, GraphChoice};
pub use listings::{ExportArgs, PassesArgs, ScenesArgs};
pub use render::RenderArgs;
pub use run::{BackendChoice, RunChoice};
pub use scene::{GeneratorChoice, LightChoice, SceneChoice, ShapeChoice};
pub use stability::StabilityArgs;
pub use verify::VerifyArgs;

use clap::{Parser, Subcommand};

/// Render-graph plugins for shadows: how right a shadow is, and what it costs.
#[derive(Debug, Parser)]
#[command(name = "shadowgraph", version, about, after_help = EXAMPLES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "Examples:
  shadowgraph render hard --scene builtin:columns --out out
  shadowgraph render hard --scene scene.glb --views views.json --view overview --swap visibility=fused
  shadowgraph verify hard --scene builtin:contact --backend wgpu
  shadowgraph check my_graph.ron
  shadowgraph graph hard --svg > hard.svg
  shadowgraph passes visibility";

/// Subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a graph on a scene: a picture, a table of what each node cost, and on request every value that travelled
    Render(RenderArgs),
    /// Run a graph and the exact truth on the same view-samples, and report wrong bits
    Verify(VerifyArgs),
    /// Compare two graphs, or two variants of one: what differs, which is faster and how certain that is, which is wrong and where
    Compare(CompareArgs),
    /// Run methods along sequences over failure scenes, and report where each holds and where it breaks
    Stability(StabilityArgs),
    /// Check graph files: every mistake at once, with its place; needs neither a scene nor a GPU
    Check(CheckArgs),
    /// Print a graph: its plan, or a drawing
    Graph(GraphArgs),
    /// List stages and their passes, or one of them with ports and parameters
    Passes(PassesArgs),
    /// List built-in scenes with their parameters, or the views of a scene
    Scenes(ScenesArgs),
    /// Write a built-in scene as a glTF binary file
    Export(ExportArgs),
}
